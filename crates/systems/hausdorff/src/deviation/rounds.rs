//! Which pieces are cut, and when it is enough.
//!
//! Work is dealt out in rounds of tasks of fixed sizes, whose outcomes are put together in task order, so that the pieces are the
//! same at any number of threads.

use super::envelope::{Envelope, Open, Piece};
use super::linear::{greater, greatest, least, lesser};
use crate::rounding::Rounding;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::Bvh;
use rayon::prelude::*;

/// What a piece must satisfy to be left as it is. Lengths are in the frame.
#[derive(Clone, Debug)]
pub(super) struct Goal {
    /// Part of the distance that the mean width between the functions may be.
    pub(super) relative: f64,
    /// Distances below this count as this: about the mean of all.
    pub(super) scale: f64,
    /// Widths that never matter.
    pub(super) floor: f64,
    /// Area times mean width that does not matter in one piece.
    pub(super) negligible: f64,
    /// Ranges of distances in which pieces must satisfy more, and how much of the distance their greatest width may be there.
    pub(super) focus: Vec<(f64, f64)>,
    pub(super) focus_relative: f64,
}

impl Goal {
    /// The mean width that is allowed where the function above has this mean.
    pub(super) fn allowed(&self, mean_upper: f64) -> f64 {
        self.part(self.relative, mean_upper)
    }

    /// The least width that this goal may ask for where the function above has this mean.
    fn finest(&self, mean_upper: f64) -> f64 {
        let focused = if self.focus.is_empty() { self.relative } else { self.focus_relative };
        self.part(lesser(self.relative, focused), mean_upper)
    }

    fn part(&self, relative: f64, mean_upper: f64) -> f64 {
        relative * greater(mean_upper, self.scale) + self.floor
    }

    /// Whether a piece of a face of this area is good enough; and the width that it should be cut to if not.
    pub(super) fn wanted(&self, piece: &Piece, face_area: f64) -> Option<f64> {
        let upper = super::linear::mean(piece.upper);
        let gap = piece.mean_gap();
        let allowed = self.allowed(upper);
        // A width that is no number is never small enough.
        let good = gap <= allowed || gap * piece.share * face_area <= self.negligible;
        if !good {
            return Some(allowed);
        }
        if self.focus.is_empty() || piece.greatest_gap() <= self.floor {
            return None;
        }
        let (low, high) = (least(piece.lower), greatest(piece.upper));
        let in_focus = self.focus.iter().any(|(from, to)| low <= *to && *from <= high);
        let allowed = self.part(self.focus_relative, upper);
        (in_focus && piece.greatest_gap() > allowed).then_some(allowed)
    }
}

/// Pieces whose longest edge is no longer than this many units of rounding are not cut.
const LEAST_SIZE: f64 = 64.0;
/// Nor are pieces after so many cuts.
const MOST_CUTS: u32 = 160;
/// Roots of a task.
const TASK: usize = 64;
/// Tasks between two looks at the limits.
const TASKS_PER_ROUND: usize = 64;

/// What rounds of refinement share.
pub(super) struct Workshop<'w> {
    pub(super) bvh: &'w Bvh,
    pub(super) rounding: Rounding,
    pub(super) control: &'w Control,
    /// Areas of the faces of A in the frame, rounded.
    pub(super) areas: &'w [f64],
}

/// Pieces that a task has made, and what it took.
#[derive(Default)]
pub(super) struct Made {
    pub(super) pieces: Vec<Piece>,
    pub(super) looks: u64,
    pub(super) distances: u64,
}

impl Workshop<'_> {
    /// Cuts each root until its parts satisfy the goal or are `most` together, and adds them to `made`. Roots that the limits leave
    /// no time for are added as they are. `watch` is called between rounds with how many roots are left.
    pub(super) fn refine(
        &self,
        roots: &[Piece],
        goal: &Goal,
        most: usize,
        made: &mut Made,
        mut watch: impl FnMut(&Made, usize),
    ) {
        let mut left = roots.len();
        for round in roots.chunks(TASK * TASKS_PER_ROUND) {
            let parts: Vec<Made> = round
                .par_chunks(TASK)
                .with_max_len(1)
                .map(|roots| {
                    let mut task = Task {
                        shop: self,
                        goal,
                        envelope: Envelope::new(self.bvh, self.rounding),
                        stack: Vec::new(),
                        made: Made::default(),
                    };
                    let mut hint = None;
                    for root in roots {
                        hint = task.root(*root, hint, most);
                    }
                    task.made.distances = task.envelope.distances();
                    task.made
                })
                .collect();
            for mut part in parts {
                made.pieces.append(&mut part.pieces);
                made.looks += part.looks;
                made.distances += part.distances;
            }
            left -= round.len();
            watch(made, left);
        }
    }
}

struct Task<'t, 'w> {
    shop: &'t Workshop<'w>,
    goal: &'t Goal,
    envelope: Envelope<'w>,
    stack: Vec<(Open, usize)>,
    made: Made,
}

impl Task<'_, '_> {
    /// Returns a face of B near the last of the parts.
    fn root(
        &mut self,
        mut root: Piece,
        hint: Option<pompeiu_core::spatial::Slot>,
        most: usize,
    ) -> Option<pompeiu_core::spatial::Slot> {
        if let Some(hint) = hint.filter(|_| root.near == self.shop.bvh.any_slot()) {
            root.near = hint;
        }
        let area = self.shop.areas[root.face as usize];
        self.envelope.lists.clear();
        self.stack.clear();
        self.stack.push((Open::new(root), 0));
        let start = self.made.pieces.len();
        let mut near = hint;
        while let Some((mut open, lists)) = self.stack.pop() {
            if self.shop.control.is_stopped() {
                self.made.pieces.push(open.piece);
                continue;
            }
            self.envelope.lists.truncate(lists);
            self.made.looks += 1;
            let look = self.envelope.look(&mut open, |mean_upper| self.goal.finest(mean_upper));
            near = Some(open.piece.near);
            let full = self.made.pieces.len() - start + self.stack.len() + 1 >= most;
            let wanted = self.goal.wanted(&open.piece, area);
            let Some(allowed) = wanted.filter(|_| !full && self.can_be_cut(&open.piece)) else {
                self.made.pieces.push(open.piece);
                continue;
            };
            let lists = self.envelope.lists.len();
            let Piece { lower, upper, share, depth, .. } = open.piece;
            for part in self.envelope.cut(&open.piece, &look, allowed).into_iter().flatten() {
                let piece = Piece {
                    corners: part.corners,
                    lower: part.below(lower),
                    upper: part.above(upper),
                    share: share * part.share,
                    depth: depth + 1,
                    ..open.piece
                };
                self.stack.push((Open { piece, beyond: part.below(open.beyond), list: open.list }, lists));
            }
        }
        near
    }

    fn can_be_cut(&self, piece: &Piece) -> bool {
        let size = crate::search::piece::longest_edge(&piece.corners);
        piece.depth < MOST_CUTS && size > LEAST_SIZE * self.shop.rounding.unit()
    }
}
