//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::flow::Flow;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let flow = &outcome.flow;
    line(&Json {
        input: &outcome.input,
        output: &outcome.output,
        flow,
        timing_ms: Timing {
            steps: milliseconds(flow.timing.steps),
            remesh: milliseconds(flow.timing.remesh),
            verdict: milliseconds(flow.timing.verdict),
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu flow --json`. Lengths are in the unit of the file, times in its square.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Flow"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    /// The result; the path is that of the input where no mesh was written.
    output: &'o File,
    #[serde(flatten)]
    flow: &'o Flow,
    timing_ms: Timing,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    steps: f64,
    remesh: f64,
    verdict: f64,
    total: f64,
}
