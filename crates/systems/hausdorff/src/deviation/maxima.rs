//! The largest distance on each face: first from its pieces, then narrower where it matters.
//!
//! Pieces are cut for statistics, which a few wide ones do not widen; but the maximum of a face is that of its worst piece. The
//! search for the largest distance of all is asked again, for one face at a time.

use super::bounds::{FaceBounds, Maximum, Precision};
use super::linear::{greater, lesser};
use super::measure::VertexDistances;
use crate::rounding::Rounding;
use crate::search::{Limits, Local, Scene, Start, search_each};
use rayon::prelude::*;

/// Width of the maximum of any face, as a part of the largest distance: colours have 256 steps.
pub(super) const OF_LARGEST: f64 = 1.0 / 256.0;
/// Width of the maximum of a face that may belong to a region, as a part of itself.
pub(super) const OF_ITSELF: f64 = 1.0 / 256.0;
/// Width of the peak of a region, as a part of itself.
const OF_PEAK: f64 = 1e-3;
/// What is asked of a search, as a part of what is wanted: rounding takes its part.
const ASKED: f64 = 0.9;
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
