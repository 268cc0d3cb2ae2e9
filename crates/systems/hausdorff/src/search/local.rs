//! The largest distance on one face of A after the other: the same bounds as the search over all, with a lower bound for each face.

use super::overlay::OVERLAY_CUTS;
use super::worker::{Keep, Worker};
use super::{Limits, Scene};
use pompeiu_core::spatial::Slot;

/// A face of A to be searched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub(crate) face: u32,
    /// A point of it that may be far away.
    pub(crate) point: [f64; 3],
    /// Cuts by which that point was placed.
    pub(crate) depth: u32,
    /// A face of B that may be near that point.
    pub(crate) near: Slot,
    /// The computed distances of its corners, each with a face of B that is so far away.
    pub(crate) corners: [(f64, Slot); 3],
}

/// The largest distance on a face, from below and from above, rounding included, and the point where it was met.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) point: [f64; 3],
    /// Cuts by which that point was placed, at most.
    pub(crate) depth: u32,
}

/// Pieces of one face that are examined at most; what is left then counts with its bound.
const BUDGET: usize = 4096;

/// Encloses the largest distance on each face as narrowly as the limits ask.
pub(crate) fn search_each(scene: &Scene<'_>, limits: Limits, starts: &[Start]) -> Vec<Local> {
    let mut worker = Worker::new(scene, limits, Keep::default(), 0.0);
    starts.iter().map(|start| worker.search_face(start)).collect()
}

impl Worker<'_> {
    fn search_face(&mut self, start: &Start) -> Local {
        self.begin_again();
        let corners = self.scene.corners(start.face);
        for (point, (distance, near)) in corners.into_iter().zip(start.corners) {
            self.know(start.face, point, distance, near);
        }
        if !corners.contains(&start.point) {
            self.sample([(start.face, start.point)].into_iter(), start.near);
        }
        self.sweep_face(start.face, &corners, start.near);
        let mut upper = 0.0;
        let pieces = std::mem::take(&mut self.out.open);
        self.refine(&pieces, BUDGET);
        for bound in self.out.open.iter().map(|piece| piece.bound).chain([self.out.upper]) {
            upper = if bound > upper { bound } else { upper };
        }
        // Points lie on the face but for the rounding of as many cuts, and a distance is off by no more than a bound is.
        let depth = start.depth.max(self.out.work.depth + OVERLAY_CUTS);
        let off = self.limits.rounding.bound(depth);
        let (met, point) = self.out.found.map_or((0.0, start.point), |found| (found.distance, found.point));
        let lower = if met > off { met - off } else { 0.0 };
        Local { lower, upper: if upper > lower { upper } else { lower }, point, depth }
    }
}
