//! The largest distance on each face: first from its pieces, then narrower where it matters.
//!
//! Pieces are cut for statistics, which a few wide ones do not widen; but the maximum of a face is that of its worst piece. The
//! search for the largest distance of all is asked again, for one face at a time.

use super::linear::{greater, lesser};
use super::measure::VertexDistances;
use super::task::FaceBounds;
use crate::rounding::Rounding;
use crate::search::{Limits, Local, Scene, Start, search_each};
use pompeiu_core::spatial::Slot;
use rayon::prelude::*;

/// The largest distance on a face, from below and from above, in the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Maximum {
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// Where the distance is at least the lower end, but for rounding.
    pub(super) point: [f64; 3],
    /// Cuts by which that point was placed.
    depth: u32,
    /// A face of the other mesh near it.
    near: Slot,
    /// How narrow it was asked to be.
    asked: Precision,
}

/// How narrow a maximum should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Precision {
    /// As the pieces have it.
    Pieces,
    /// [`OF_LARGEST`] of the largest distance of all: a step of a colour map.
    Map,
    /// [`OF_ITSELF`] of itself: to tell whether the face belongs to a region.
    Level,
    /// [`OF_PEAK`] of itself: the peak of a region.
    Peak,
}

/// Width of the maximum of any face, as a part of the largest distance: colours have 256 steps.
const OF_LARGEST: f64 = 1.0 / 256.0;
/// Width of the maximum of a face that may belong to a region, as a part of itself.
const OF_ITSELF: f64 = 1.0 / 256.0;
/// Width of the peak of a region, as a part of itself.
const OF_PEAK: f64 = 1e-3;
/// What is asked of a search, as a part of what is wanted: rounding takes its part.
const ASKED: f64 = 0.9;
/// Points placed by weights lie on the face up to 28 units of rounding (see [`rounding`](crate::rounding)): less than three cuts.
const CUTS_OF_POINT: u32 = 3;
/// Faces of a task.
const TASK: usize = 32;
/// Tasks between two looks at the limits.
const TASKS_PER_ROUND: usize = 64;

/// The maxima of all faces, and what it takes to make them narrower.
pub(super) struct Maxima<'m> {
    pub(super) scene: &'m Scene<'m>,
    pub(super) vertices: &'m VertexDistances,
    pub(super) rounding: Rounding,
    /// Widths below this are narrow.
    pub(super) floor: f64,
    /// No distance is greater.
    pub(super) largest: f64,
    /// By face.
    pub(super) of_faces: Vec<FaceBounds>,
    /// Faces searched, each time.
    pub(super) searched: u64,
}

impl Maxima<'_> {
    /// Whether the maximum of a face is wider than it should be, and was not already asked to be so narrow.
    pub(super) fn is_wide(&self, face: u32, precision: Precision) -> bool {
        let maximum = &self.of_faces[face as usize].max;
        let allowed = greater(self.allowed(precision, maximum.upper), self.floor);
        maximum.asked < precision && maximum.upper - maximum.lower > allowed
    }

    fn allowed(&self, precision: Precision, upper: f64) -> f64 {
        match precision {
            Precision::Pieces => f64::INFINITY,
            Precision::Map => OF_LARGEST * self.largest,
            Precision::Level => OF_ITSELF * upper,
            Precision::Peak => OF_PEAK * upper,
        }
    }

    /// Makes the maxima of some faces narrower. `tell` is called between rounds with the number of faces left.
    pub(super) fn narrow(&mut self, faces: &[u32], precision: Precision, tell: &mut dyn FnMut(u64, usize)) {
        let part = match precision {
            Precision::Pieces => return,
            Precision::Map => 0.0,
            Precision::Level => OF_ITSELF,
            Precision::Peak => OF_PEAK,
        };
        let length = if precision == Precision::Map { OF_LARGEST * self.largest } else { self.floor };
        let limits = Limits {
            diagonal: 1.0,
            tolerance: ASKED * length,
            tolerance_of_distance: ASKED * part,
            threshold: None,
            rounding: self.rounding,
            least_size: 16.0 * self.rounding.unit(),
        };
        let mut left = faces.len();
        for round in faces.chunks(TASK * TASKS_PER_ROUND) {
            if self.scene.control.is_stopped() {
                return;
            }
            let of_task = |faces: &[u32]| {
                let start = |face: &u32| {
                    let Maximum { point, depth, near, .. } = self.of_faces[*face as usize].max;
                    let corners = self.vertices.of_corners(self.scene.a.faces()[*face as usize]);
                    Start { face: *face, point, depth, near, corners }
                };
                let starts: Vec<Start> = faces.iter().map(start).collect();
                search_each(self.scene, limits, &starts)
            };
            let found: Vec<Vec<Local>> = round.par_chunks(TASK).with_max_len(1).map(of_task).collect();
            for (face, local) in round.iter().zip(found.into_iter().flatten()) {
                let maximum = &mut self.of_faces[*face as usize].max;
                maximum.asked = precision;
                maximum.upper = lesser(maximum.upper, local.upper);
                if local.lower > maximum.lower {
                    maximum.lower = lesser(local.lower, maximum.upper);
                    (maximum.point, maximum.depth) = (local.point, local.depth);
                }
            }
            self.searched += round.len() as u64;
            left -= round.len();
            tell(self.searched, left);
        }
    }
}

impl Maximum {
    /// As the pieces of a face have it.
    pub(super) fn of_piece((lower, upper): (f64, f64), point: [f64; 3], near: Slot) -> Self {
        Self { lower, upper, point, depth: CUTS_OF_POINT, near, asked: Precision::Pieces }
    }

    /// Takes a corner of the face with a distance of at least `lower` into account.
    pub(super) fn know_point(&mut self, lower: f64, point: [f64; 3], near: Slot) {
        if lower > self.lower {
            self.lower = lesser(lower, self.upper);
            (self.point, self.depth, self.near) = (point, 0, near);
        }
    }
}
