//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::many::Problem;
use pompeiu::complexity::ComplexityReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let total_ms = milliseconds(outcome.total);
    line(&Json { report: &outcome.report, failed: &outcome.problems, total_ms })
}

/// The answer of `pompeiu complexity --json`. Lengths are in pixels of pictures, and in the unit of drawings and lists.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Complexity"))]
pub(crate) struct Json<'o> {
    #[serde(flatten)]
    report: &'o ComplexityReport,
    /// What cannot be used, and why.
    failed: &'o [Problem],
    /// From the command's start to its answer, files included.
    total_ms: f64,
}
