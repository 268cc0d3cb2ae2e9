//! One face of A, cut into pieces until they are as narrow as asked.

use super::cells::{Cells, Limits, Rest, Task};
use super::corners::Start;
use super::criterion::Criterion;
use super::envelope::{Envelope, Open, Wish};
use super::planes::Planes;
use super::polygon::{Outline, Piece, Polygon};
use crate::rounding::Rounding;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Neighbours};

/// Pieces whose longest edge is no longer than this many units of rounding are not cut.
const LEAST_SIZE: f64 = 64.0;
/// Nor are pieces after so many cuts.
pub(super) const MOST_CUTS: u32 = 160;
/// Looks between two questions to the clock.
const LOOKS_PER_CHECK: u64 = 64;
/// Faces of B that are farther than this many times the distance of the farthest corner are not listed at first.
const REACH: f64 = 1.25;

/// Cuts faces, one after the other.
pub(super) struct Cutter<'c> {
    envelope: Envelope<'c>,
    planes: Option<Planes<'c>>,
    cells: Option<Cells<'c>>,
    /// Parts of a face that are left to cells.
    left: Vec<Rest>,
    control: &'c Control,
    rounding: Rounding,
    /// No distance is greater.
    largest: f64,
    /// About the mean distance.
    scale: f64,
    stack: Vec<Open>,
    /// Those of the last face.
    pub(super) pieces: Vec<Piece>,
    pub(super) looks: u64,
}

impl<'c> Cutter<'c> {
    pub(super) fn new(
        bvh: &'c Bvh,
        neighbours: Option<&'c Neighbours>,
        rounding: Rounding,
        control: &'c Control,
        largest: f64,
        scale: f64,
    ) -> Self {
        Self {
            envelope: Envelope::new(bvh, rounding),
            planes: neighbours.map(|neighbours| Planes::new(bvh, neighbours)),
            left: Vec::new(),
            cells: neighbours.map(|neighbours| Cells::new(bvh, neighbours, rounding, scale)),
            control,
            rounding,
            largest,
            scale,
            stack: Vec::new(),
            pieces: Vec::new(),
            looks: 0,
        }
    }

    /// Begins with the faces of another task, whose pieces do not depend on what was cut before.
    pub(super) fn begin_task(&mut self) {
        if let Some(cells) = &mut self.cells {
            cells.begin_task();
        }
    }

    /// Point–triangle distances evaluated so far.
    pub(super) fn distances(&self) -> u64 {
        self.envelope.workspace.distances
    }

    /// The point of the last face with these weights of its second and third corner.
    pub(super) fn point(&self, at: [f64; 2]) -> [f64; 3] {
        self.envelope.scale.point(at).to_array()
    }

    /// A part of the last face, cut across the longest way between two of its corners.
    pub(super) fn halve(&self, polygon: &Polygon) -> Option<[Polygon; 2]> {
        self.envelope.halve(polygon)
    }

    /// Cuts a face until its pieces satisfy the criterion or are `most`. What the limits leave no time for stays as it is.
    pub(super) fn cut(&mut self, start: &Start, criterion: &Criterion, most: usize) {
        self.pieces.clear();
        self.stack.clear();
        self.envelope.begin(start.corners);
        let farthest = start.distances.iter().fold(self.scale, |d, x| if *x > d { *x } else { d });
        let whole = Polygon::whole(self.largest);
        let mut stopped = self.control.is_stopped();
        if stopped {
            self.pieces.push(self.envelope.without_looking(start, self.largest));
            return;
        }
        if let Some(cells) = &mut self.cells {
            let Envelope { scale, workspace, .. } = &mut self.envelope;
            let limits = Limits { most, control: self.control };
            let task = Task { scale, criterion, area: start.area };
            let planes = self.planes.as_mut();
            let left = &mut self.left;
            left.clear();
            let tried = planes
                .is_some_and(|planes| planes.cut(task, start, limits, workspace, &mut self.pieces, left));
            if !tried {
                left.push(Rest { outline: Outline::WHOLE, near: start.near[0] });
            }
            cells.cut(task, left, limits, workspace, &mut self.pieces);
            stopped = self.control.is_stopped();
            self.looks += self.pieces.len() as u64;
            for rest in &cells.rest {
                let polygon = Polygon::unknown(rest.outline, self.largest);
                self.stack.push(self.envelope.open(&polygon, rest.near));
            }
        } else {
            self.stack.push(self.envelope.open(&whole, start.near[0]));
        }
        while let Some(mut open) = self.stack.pop() {
            if stopped {
                self.keep(&open);
                continue;
            }
            self.looks += 1;
            let weights = open.polygon.outline.weights();
            let wish = Wish {
                weights,
                width: criterion.width_of(weights.iter().sum::<f64>() * start.area),
                negligible: criterion.negligible(&weights, start.area),
                reach: REACH * farthest,
            };
            let look = self.envelope.look(&mut open, &wish);
            stopped = self.looks.is_multiple_of(LOOKS_PER_CHECK) && self.control.is_stopped();
            let full = self.pieces.len() + self.stack.len() + 1 >= most;
            let width = criterion.width_unless_met(&open.polygon, &weights, start.area);
            let Some(width) = width.filter(|_| !full && self.can_be_cut(&open.polygon)) else {
                self.keep(&open);
                continue;
            };
            match self.envelope.cut(&open.polygon, &look, width) {
                Some(parts) => {
                    for part in &parts {
                        self.stack.push(self.envelope.part(&open, part));
                    }
                }
                None => self.keep(&open),
            }
        }
    }

    fn keep(&mut self, open: &Open) {
        self.pieces.push(Piece { polygon: open.polygon, near: open.near });
    }

    fn can_be_cut(&self, polygon: &Polygon) -> bool {
        polygon.outline.depth < MOST_CUTS && self.envelope.size(polygon) > LEAST_SIZE * self.rounding.unit()
    }
}
