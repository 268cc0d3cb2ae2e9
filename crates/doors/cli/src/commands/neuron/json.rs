//! The outcome as one JSON object.

use crate::json::line;
use pompeiu::neuron::NeuronReport;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(report: &NeuronReport) -> serde_json::Result<String> {
    line(&Json { report })
}

/// The answer of `pompeiu neuron --json`. Lengths are in micrometres.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Neuron"))]
pub(crate) struct Json<'o> {
    #[serde(flatten)]
    report: &'o NeuronReport,
}
