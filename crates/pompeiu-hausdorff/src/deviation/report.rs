//! What a deviation analysis answers.

use super::envelope::Piece;
use super::regions::Region;
use super::statistics::{Percentile, Statistics};
use crate::report::{DirectedReport, Direction, Enclosure, StopReason};
use pompeiu_core::geom::Frame;
use std::time::Duration;

/// How far two meshes deviate from each other, both ways.
///
/// The two directions answer different questions and are never mixed unasked. With A as it should be and B as it is: what
/// of A is far from B is *missing* in B; what of B is far from A is *invented* by it.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// Encloses the Pompeiu–Hausdorff distance, the greater of both directed ones.
    pub distance: Enclosure,
    /// How far A is from B: what is missing in B.
    pub a_to_b: DirectedDeviation,
    /// How far B is from A: what B has invented.
    pub b_to_a: DirectedDeviation,
    /// For each share asked for the greater of the two directions' percentiles: both surfaces are within this distance of the
    /// other one, but for at most the rest of the area of each. None if one of them has no area.
    pub greater_percentiles: Option<Vec<Percentile>>,
    /// Statistics over the areas of both together. None if neither has any.
    pub pooled: Option<Statistics>,
}

/// How far a mesh deviates from another one.
#[derive(Clone, Debug)]
pub struct DirectedDeviation {
    /// Which way.
    pub direction: Direction,
    /// The largest distance of all, and the two points that prove it.
    pub distance: DirectedReport,
    /// Over the area of the mesh. None if it has no area: all its faces are segments or points, or too thin for double precision
    /// to tell them from such.
    pub statistics: Option<Statistics>,
    /// By face.
    pub faces: Vec<FaceDeviation>,
    /// Distances of the vertices. NaN for those that belong to no face.
    pub vertices: Vec<f64>,
    /// The exact distance of each vertex differs by at most this from the one given.
    pub vertex_error: f64,
    /// The worst regions, the worst first.
    pub regions: Vec<Region>,
    /// The parts of the surface that are farther than the threshold, the worst first, if one was given.
    pub beyond_threshold: Vec<Region>,
    /// Why refining ended. [`StopReason::Tolerance`]: all statistics are as narrow as asked. [`StopReason::Rounding`]: what is
    /// wider cannot be made narrower, as a percentile where the distribution has a gap, or a share above a threshold at which much
    /// of the area lies. The enclosures are valid in every case.
    pub stop: StopReason,
    /// What it took.
    pub work: DeviationWork,
    pub(super) field: Field,
}

/// How far one face is from the other mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceDeviation {
    /// Encloses the distance of its farthest point.
    pub max: Enclosure,
    /// Encloses the distance of its nearest point.
    pub min: Enclosure,
    /// Encloses the mean distance over its area; of a face without area, the mean over its corners' weights.
    pub mean: Enclosure,
}

impl DirectedDeviation {
    /// Number of pieces that the faces were cut into.
    pub fn pieces(&self) -> usize {
        self.field.pieces.len()
    }
}

/// How much was done, in counts that do not depend on the machine, and how long it took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeviationWork {
    /// Pieces at the end.
    pub pieces: u64,
    /// Pieces looked at.
    pub looks: u64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
    /// Rounds of refinement.
    pub rounds: u32,
    /// Time to build the tree over the other mesh.
    pub build: Duration,
    /// Time to find the largest distance.
    pub search: Duration,
    /// Time for everything else.
    pub refine: Duration,
}

/// The pieces behind a report, ordered by face.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) frame: Frame,
    pub(super) pieces: Vec<Piece>,
    /// Where those of each face start, and one end more.
    pub(super) starts: Vec<u32>,
    /// Distances are at most this, in the frame.
    pub(super) largest: f64,
    /// Areas of the faces in the frame, from below and from above.
    pub(super) areas: Vec<(f64, f64)>,
}

impl Field {
    /// Orders pieces by face; those of a face stay in the order they came in.
    pub(super) fn new(
        frame: Frame,
        pieces: &[Piece],
        faces: usize,
        largest: f64,
        areas: Vec<(f64, f64)>,
    ) -> Self {
        let mut starts = vec![0_u32; faces + 1];
        for piece in pieces {
            starts[piece.face as usize + 1] += 1;
        }
        for f in 0..faces {
            starts[f + 1] += starts[f];
        }
        let mut next = starts.clone();
        let mut order = vec![0_u32; pieces.len()];
        for (i, piece) in pieces.iter().enumerate() {
            let place = &mut next[piece.face as usize];
            order[*place as usize] = i as u32;
            *place += 1;
        }
        let pieces = order.into_iter().map(|i| pieces[i as usize]).collect();
        Self { frame, pieces, starts, largest, areas }
    }

    /// The pieces of a face.
    pub(super) fn of_face(&self, face: usize) -> &[Piece] {
        &self.pieces[self.starts[face] as usize..self.starts[face + 1] as usize]
    }
}
