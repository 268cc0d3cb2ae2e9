//! Cover, generate, cut: the search on pieces that the sweep left.

use super::bisectors::{Bisectors, MOST_CELLS};
use super::game::{self, Game, MAX_ROWS};
use super::piece::{BISECT_BELOW_DEPTH, INHERITED, LEAST_OVERHANG, LEAST_PART, Parts, Piece};
use super::rows::Rows;
use super::sweep::Settled;
use super::worker::{STOP_CHECK, SlotProof, Worker, at, centre, max3, with_centre};
use pompeiu_core::spatial::{Cover, Nearest, Slot};

/// A cut that leaves this fraction of a piece on both sides needs no second thought.
const LARGE_PART: f64 = 0.05;
/// A part with more than this fraction of a piece is halved at once.
const MOST_OF_A_PIECE: f64 = 0.75;
/// Rows added to a game after its first solution.
const GENERATED_ROWS: usize = 4;
/// A new row must lower the bound by this part of its excess over the lower bound to be worth another.
const LEAST_GAIN: f64 = 0.02;
/// Pieces this deep are not cut further; halving edges 200 times reaches any size that doubles can hold here.
const MAX_DEPTH: u32 = 240;
/// Bisections that a piece over too many faces for an overlay is worth.
const OVERLAY_BISECTIONS: u32 = 32;

impl Worker<'_> {
    /// Searches pieces depth first until they are gone or `budget` of them were examined; what is left stays open.
    pub(super) fn refine(&mut self, pieces: &[Piece], budget: usize) {
        let mut stack: Vec<Piece> = pieces.iter().rev().copied().collect();
        for i in 0..budget {
            if i % STOP_CHECK == 0 && self.scene.stopped() {
                break;
            }
            let Some(piece) = stack.pop() else { break };
            self.examine(piece, &mut stack);
        }
        stack.reverse();
        self.out.open.append(&mut stack);
    }

    /// Cover, generate, cut: discards one piece or pushes its parts.
    ///
    /// # Source
    /// Adding the face that is nearest where the bound is attained is the cutting-plane method, `kelley_cutting_1960`, on
    /// the lower envelope of the distances from faces.
    fn examine(&mut self, piece: Piece, stack: &mut Vec<Piece>) {
        self.out.work.pieces += 1;
        self.out.work.depth = self.out.work.depth.max(piece.depth);
        let mut retry = false;
        if piece.overlay {
            match self.overlay_or_bisect(&piece, piece.near[0], stack) {
                Settled::No(over_centre) => retry = over_centre.is_none(),
                Settled::Yes(_) | Settled::TooMany(_) => return,
            }
        }
        let points = with_centre(&piece.corners);
        let bvh = self.scene.bvh;

        // Cover: one face of B near all corners.
        let mut rows = Rows::default();
        let mut start = Nearest { slot: piece.near[0], distance_sq: f64::INFINITY };
        for &slot in piece.near() {
            let d = bvh.four_distances_sq(&points, slot, &mut self.workspace);
            let farthest = max3(d);
            if farthest <= self.limit_sq(piece.depth) {
                return self.discard(piece, farthest.sqrt(), || SlotProof::Face(slot));
            }
            if d[3] < start.distance_sq {
                start = Nearest { slot, distance_sq: d[3] };
            }
            rows.push(slot, [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()]);
        }
        let nearest = if piece.nearest_known {
            start
        } else {
            self.out.work.queries += 1;
            // A point within the limit will not raise the lower bound by much: any face near it will do to cut by.
            match bvh.cover_or_neighbour(&points, self.limit_sq(piece.depth), start, &mut self.workspace) {
                Cover::By { slot, distance_sq } => {
                    return self.discard(piece, distance_sq.sqrt(), || SlotProof::Face(slot));
                }
                Cover::Nearest(nearest) => {
                    self.raise(piece.face, centre(&points), nearest);
                    nearest
                }
                Cover::Neighbour(nearest) => nearest,
            }
        };
        if retry && !matches!(self.overlay_or_bisect(&piece, nearest.slot, stack), Settled::No(_)) {
            return;
        }
        self.add_row(&mut rows, nearest.slot, &points);

        // Some corner is far from all known faces, and the nearest face ends well inside: cut there at once.
        let reach = self.limits.reach(self.lower);
        if rows.uncovered_corner(self.limit(piece.depth)).is_some()
            && let Some(parts) = piece.prism_cut(bvh.corners(nearest.slot), reach, LARGE_PART)
        {
            let bound = rows.least_bound() + self.limits.rounding.bound(piece.depth);
            return self.push_parts(
                &piece,
                &parts,
                bound,
                rows.inherited(nearest.slot, &[0.0; MAX_ROWS]),
                false,
                stack,
            );
        }

        // Generate: mixtures of the faces nearest where the bound is attained.
        let mut game = None;
        let mut before = f64::INFINITY;
        for _ in 0..=GENERATED_ROWS {
            // A corner that no row is near to has the last word on any mixture: ask there first.
            let (x, start) = if let Some((corner, start)) = rows.uncovered_corner(self.limit(piece.depth)) {
                game = None;
                (piece.corners[corner], start)
            } else {
                let solved = self.solve(&rows);
                if solved.value <= self.limit(piece.depth) {
                    return self.discard(piece, solved.value, || rows.mixture(&solved.weights));
                }
                game = Some(solved);
                if solved.value > before - LEAST_GAIN * (before - self.lower) {
                    break;
                }
                before = solved.value;
                let x = at(&piece.corners, solved.corners);
                let slot = rows.likely_nearest(solved.corners);
                self.workspace.distances += 1;
                (x, Nearest { slot, distance_sq: bvh.distance_sq(x, slot) })
            };
            if start.distance_sq <= self.limit_sq(piece.depth) {
                break;
            }
            let nearest = self.query(piece.face, x, start);
            if !self.add_row(&mut rows, nearest.slot, &points) {
                break;
            }
        }
        let game = game.unwrap_or_else(|| self.solve(&rows));
        // What is too small to cut is discarded with a bound above the limit, and the enclosure comes out wider.
        let too_small = piece.depth >= MAX_DEPTH || piece.size() <= self.limits.least_size;
        if game.value <= self.limit(piece.depth) || too_small {
            return self.discard(piece, game.value, || rows.mixture(&game.weights));
        }

        // Cut: where the nearest face ends, where two faces are equally far, or in the middle.
        let bound = game.value + self.limits.rounding.bound(piece.depth);
        let cut = piece.prism_cut(bvh.corners(nearest.slot), reach, LEAST_PART);
        if cut.is_none()
            && self.cut_along_bisectors(&piece, bound, &rows, at(&piece.corners, game.corners), stack)
        {
            return;
        }
        let parts = cut.unwrap_or_else(|| piece.bisect());
        self.push_parts(&piece, &parts, bound, rows.inherited(nearest.slot, &game.weights), false, stack);
    }

    /// Discards what is within the limit of the cells between the faces of the rows, and puts the rest on the stack; false where the piece
    /// stays whole.
    fn cut_along_bisectors(
        &mut self,
        piece: &Piece,
        bound: f64,
        rows: &Rows,
        around: [f64; 3],
        stack: &mut Vec<Piece>,
    ) -> bool {
        if piece.depth >= BISECT_BELOW_DEPTH {
            return false;
        }
        let bvh = self.scene.bvh;
        let least = LEAST_OVERHANG * self.limits.reach(self.lower);
        if !self.bisectors.cut(&piece.corners, around, bvh, rows.slots(), least) {
            return false;
        }
        let bisectors = std::mem::take(&mut self.bisectors);
        let Bisectors { cells, slots, .. } = &bisectors;
        let mut worst = (self.limit_sq(piece.depth), None);
        let mut farthest = [0.0; MOST_CELLS];
        for (cell, farthest) in cells.iter().zip(&mut farthest) {
            self.out.work.depth = self.out.work.depth.max(piece.depth + cell.cuts);
            for corners in cell.corners().chunks(4) {
                let points = [0, 1, 2].map(|k| std::array::from_fn(|l| corners[l.min(corners.len() - 1)][k]));
                let distances = bvh.four_distances_sq(&points, slots[cell.face], &mut self.workspace);
                for (distance_sq, corner) in distances.into_iter().zip(corners) {
                    *farthest = if distance_sq > *farthest { distance_sq } else { *farthest };
                    if distance_sq > worst.0 {
                        worst = (distance_sq, Some((corner.to_array(), slots[cell.face])));
                    }
                }
            }
        }
        // The cells that meet at a peak are covered once that is known.
        if let (distance_sq, Some((x, slot))) = worst {
            self.query(piece.face, x, Nearest { slot, distance_sq });
        }
        self.out.work.cuts += cells.len() as u64 - 1;
        let whole = piece.area();
        for (cell, farthest) in cells.iter().zip(farthest) {
            let slot = slots[cell.face];
            let depth = piece.depth + cell.cuts;
            let distance = farthest.sqrt();
            let own = distance + self.limits.rounding.bound(depth);
            let inherited = bound + self.limits.rounding.cut() * f64::from(cell.cuts);
            let (near, near_count) = rows.inherited(slot, &[0.0; MAX_ROWS]);
            for corners in cell.triangles() {
                let part = Piece {
                    corners,
                    bound: if own < inherited { own } else { inherited },
                    near,
                    near_count,
                    nearest_known: false,
                    overlay: false,
                    depth,
                    face: piece.face,
                };
                if farthest <= self.limit_sq(depth) {
                    self.discard(part, distance, || SlotProof::Face(slot));
                } else if part.area() > MOST_OF_A_PIECE * whole {
                    // Where faces bend, what is linear around one point may cut off next to nothing, time and again.
                    let near = (near, near_count);
                    self.push_parts(&part, &part.bisect(), part.bound, near, false, stack);
                } else {
                    stack.push(part);
                }
            }
        }
        self.bisectors = bisectors;
        true
    }

    /// Settles a piece by its overlay, or bisects it where it lies over too many faces.
    fn overlay_or_bisect(&mut self, piece: &Piece, hint: Slot, stack: &mut Vec<Piece>) -> Settled {
        match self.settle_by_overlay(piece, hint) {
            Settled::TooMany(over_centre) if piece.depth < OVERLAY_BISECTIONS => {
                self.push_parts(
                    piece,
                    &piece.bisect(),
                    piece.bound,
                    ([over_centre; INHERITED], 1),
                    true,
                    stack,
                );
                Settled::TooMany(over_centre)
            }
            Settled::TooMany(over_centre) => Settled::No(Some(over_centre)),
            settled => settled,
        }
    }

    /// Puts the parts of a piece with this bound on the stack.
    fn push_parts(
        &mut self,
        piece: &Piece,
        parts: &Parts,
        bound: f64,
        (near, near_count): ([Slot; INHERITED], u8),
        overlay: bool,
        stack: &mut Vec<Piece>,
    ) {
        self.out.work.cuts += 1;
        let bound = if bound < piece.bound { bound } else { piece.bound };
        for &corners in parts.as_slice() {
            // The parts cover the piece up to the rounding of the cut.
            stack.push(Piece {
                corners,
                bound: bound + self.limits.rounding.cut(),
                near,
                near_count,
                nearest_known: false,
                overlay,
                depth: piece.depth + 1,
                face: piece.face,
            });
        }
    }

    pub(super) fn solve(&mut self, rows: &Rows) -> Game {
        self.out.work.games += 1;
        game::solve(rows.distances())
    }

    /// Adds the distances of the corners from a face; false if it is there already or there is no room.
    pub(super) fn add_row(&mut self, rows: &mut Rows, slot: Slot, points: &[[f64; 4]; 3]) -> bool {
        if !rows.has_room_for(slot) {
            return false;
        }
        let d = self.scene.bvh.four_distances_sq(points, slot, &mut self.workspace);
        rows.push(slot, [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()]);
        true
    }
}
