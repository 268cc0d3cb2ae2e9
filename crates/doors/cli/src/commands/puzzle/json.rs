//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use pompeiu::puzzle::PuzzleReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json { report: &outcome.report, total_ms: milliseconds(outcome.total) })
}

/// The answer of `pompeiu puzzle --json`. Lengths are in the unit of the size.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Puzzle"))]
pub(crate) struct Json<'o> {
    #[serde(flatten)]
    report: &'o PuzzleReport,
    /// From the command's start to its answer.
    total_ms: f64,
}
