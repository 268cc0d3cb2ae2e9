//! The matrix as one JSON object.

use super::run::Answer;
use crate::json::{line, milliseconds};
use crate::many::Problem;
use pompeiu::hausdorff::{StopReason, Tolerance};
use pompeiu::matching::matrix::Task;
use serde::Serialize;

impl Answer {
    /// Square arrays of one end of the enclosures.
    fn square(&self, end: usize) -> Vec<Vec<Option<f64>>> {
        let all = 0..self.names.len();
        let unusable = |i: usize| self.is_unusable(i);
        let entry = |i: usize, j: usize| self.bounds(i, j).filter(|_| !unusable(i)).map(|bounds| bounds[end]);
        all.clone().map(|i| all.clone().map(|j| entry(i, j)).collect()).collect()
    }
}

/// The answer of `pompeiu matrix --json`. Lengths are in the unit of the files.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Matrix"))]
pub(crate) struct Json<'a> {
    /// The files, in the order of rows and columns.
    files: &'a [String],
    /// Width of the intervals that was asked for.
    #[serde(flatten)]
    tolerance: Tolerance,
    /// Whether entry i, j is h(i, j) instead of H(i, j).
    directed: bool,
    /// Lower ends; null where one of the two cannot be used, or was not measured.
    lower: Vec<Vec<Option<f64>>>,
    /// Upper ends; null where one of the two cannot be used, or was not measured.
    upper: Vec<Vec<Option<f64>>>,
    /// Why the run ended: `tolerance` unless pairs are open.
    stop: StopReason,
    /// Directed distances that were not measured, or less narrowly than asked, by rows and columns.
    open: Vec<Task>,
    /// What cannot be used, and why.
    failed: &'a [Problem],
    /// Point–triangle distances evaluated.
    distances: u64,
    /// Milliseconds in all.
    timing_ms: f64,
}

/// The matrix on one line.
pub(super) fn json(answer: &Answer) -> serde_json::Result<String> {
    line(&Json {
        files: &answer.names,
        tolerance: answer.tolerance,
        directed: answer.directed,
        lower: answer.square(0),
        upper: answer.square(1),
        stop: answer.matrix.stop_reason(),
        open: answer.open(),
        failed: &answer.problems,
        distances: answer.matrix.distances(),
        timing_ms: milliseconds(answer.total),
    })
}
