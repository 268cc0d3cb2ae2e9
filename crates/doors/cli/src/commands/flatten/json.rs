//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::line;
use crate::pair::File;
use pompeiu::flatten::FlattenReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json { input: &outcome.input, report: &outcome.report })
}

/// The answer of `pompeiu flatten --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Flatten"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    #[serde(flatten)]
    report: &'o FlattenReport,
}
