//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::line;
use crate::pair::File;
use pompeiu::core::mesh::Rounding;
use pompeiu::core::mesh::repair::RepairReport;
use pompeiu::hausdorff::Enclosure;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json {
        input: &outcome.input,
        output: &outcome.output,
        written: outcome.written,
        report: &outcome.report,
        rounding: outcome.rounding,
        within: outcome.distance.map(|(within, _)| within),
        distance: outcome.distance.map(|(_, distance)| distance),
    })
}

/// The answer of `pompeiu repair --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Repair"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    output: &'o File,
    /// Whether the output was written: not where the distance asked for is not proven.
    written: bool,
    #[serde(flatten)]
    report: &'o RepairReport,
    /// What rounding to the coordinates of the output did first.
    rounding: Rounding,
    /// The distance asked for; null without.
    within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input and output; null where none was asked for.
    distance: Option<Enclosure>,
}
