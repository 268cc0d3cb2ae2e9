//! A report, and what it takes to put two together.

use super::entry::Sum;
use super::pieces::Pieces;
use super::report::{DirectedDeviation, FaceDeviation};
use super::statistics::Summary;

/// A report, and what it takes to put two together.
pub(super) struct Outcome {
    pub(super) report: DirectedDeviation,
    pub(super) pieces: Pieces,
    pub(super) summary: Option<Summary>,
    /// Up to the ends of the bins; empty without a summary.
    pub(super) areas: Vec<Sum>,
    /// No distance is greater, in the frame.
    pub(super) largest: f64,
}

impl Outcome {
    /// Bytes that it takes.
    pub(super) fn bytes(&self) -> usize {
        self.pieces.bytes()
            + self.report.faces.len() * size_of::<FaceDeviation>()
            + size_of_val(&self.report.vertices[..])
    }
}
