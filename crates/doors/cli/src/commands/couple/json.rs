//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use pompeiu::coupling::scenario::RunReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json {
        kind: outcome.scene.kind,
        windows: outcome.scene.windows,
        runs: &outcome.runs,
        total_ms: milliseconds(outcome.total),
    })
}

/// The answer of `pompeiu couple --json`.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Couple"))]
pub(crate) struct Json<'o> {
    /// What is coupled: piston, tube, channel, box.
    kind: &'static str,
    /// Windows that were asked for.
    windows: usize,
    /// The run, or one for each scheme that is compared.
    runs: &'o [RunReport],
    /// From the command's start to its answer, files included.
    total_ms: f64,
}
