//! What is measured, against what, and what is asked.

use crate::rounding::Rounding;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Neighbours};
use pompeiu_core::{FaceId, TriMesh};

/// What is measured, and against what.
pub(crate) struct Scene<'s> {
    pub(crate) a: &'s TriMesh,
    /// Faces of A, neighbours close together.
    pub(crate) order: &'s [u32],
    pub(crate) frame: &'s Frame,
    pub(crate) bvh: &'s Bvh,
    /// Of the triangles in the tree; none where overlays are not tried.
    pub(crate) neighbours: Option<&'s Neighbours>,
    pub(crate) control: &'s Control,
}

impl Scene<'_> {
    /// Corners of a face of A in the frame of the search.
    #[inline]
    pub(crate) fn corners(&self, face: u32) -> [[f64; 3]; 3] {
        let [a, b, c] = self.a.corners(FaceId(face));
        [self.frame.map(a), self.frame.map(b), self.frame.map(c)]
    }

    pub(super) fn stopped(&self) -> bool {
        self.control.is_stopped()
    }
}

/// What is asked, in units of the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Of the joint bounding box.
    pub(crate) diagonal: f64,
    /// Width of the enclosure aimed for: the greater of a length and a part of the distance.
    pub(crate) tolerance: f64,
    pub(crate) tolerance_of_distance: f64,
    /// Bounds up to this are good enough.
    pub(crate) threshold: Option<f64>,
    pub(crate) rounding: Rounding,
    /// Pieces no larger are not cut.
    pub(crate) least_size: f64,
}

impl Limits {
    /// The width aimed for at a distance, whether or not rounding allows it.
    pub(crate) fn requested(&self, distance: f64) -> f64 {
        let part = self.tolerance_of_distance * distance;
        if part > self.tolerance { part } else { self.tolerance }
    }

    /// How far bounds may lie above the lower one: the width aimed for, or the least that rounding allows.
    pub(crate) fn reach(&self, lower: f64) -> f64 {
        let requested = self.requested(lower);
        let least = self.rounding.least_tolerance();
        if requested > least { requested } else { least }
    }

    /// A piece after `depth` cuts may be discarded when its computed bound is no greater.
    pub(crate) fn at(&self, lower: f64, depth: u32) -> f64 {
        let reach = lower - self.rounding.lower() + self.reach(lower);
        let reach = match self.threshold {
            Some(threshold) if threshold > reach => threshold,
            _ => reach,
        };
        reach - self.rounding.bound(depth)
    }
}
