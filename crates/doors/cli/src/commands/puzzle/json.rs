//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::line;
use pompeiu::puzzle::PuzzleReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json { report: &outcome.report })
}

/// The answer of `pompeiu puzzle --json`. Lengths are in the unit of the size.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Puzzle"))]
pub(crate) struct Json<'o> {
    #[serde(flatten)]
    report: &'o PuzzleReport,
}
