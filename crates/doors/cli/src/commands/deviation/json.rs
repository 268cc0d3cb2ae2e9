//! The outcome as one JSON object.

use super::run::{Outcome, directions};
use super::verdict::Verdict;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::hausdorff::deviation::{BandReport, Deviation, DirectedDeviation, LeftOut};
use pompeiu::matching::align::Registration;
use serde::Serialize;
use std::time::Duration;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let both = |part: fn(&DirectedDeviation) -> Duration| {
        milliseconds(directions(&outcome.deviation).map(|(_, directed)| part(directed)).iter().sum())
    };
    line(&Json {
        a: &outcome.a,
        b: &outcome.b,
        alignment: outcome.alignment.as_ref(),
        unit: &outcome.unit,
        accuracy: outcome.accuracy,
        threshold: outcome.threshold,
        verdict: outcome.verdict(),
        bands: outcome.bands.as_ref(),
        left_out: outcome.left_out.as_ref().map(|[a, b]| Rest { a, b }),
        deviation: &outcome.deviation,
        timing_ms: Timing {
            read: milliseconds(outcome.read),
            build: both(|directed| directed.work.build),
            search: both(|directed| directed.work.search),
            refine: both(|directed| directed.work.refine),
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu deviation --json`. Lengths are in the unit of the files.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Deviation"))]
pub(crate) struct Json<'o> {
    a: &'o File,
    b: &'o File,
    /// How B was moved onto A before; absent if that was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    alignment: Option<&'o Registration>,
    /// The name of the unit of length, if one was given.
    unit: &'o str,
    /// Largest width of intervals that was asked for, relative to their values.
    accuracy: f64,
    /// The length beyond which shares and regions were asked for; absent if none was.
    #[serde(skip_serializing_if = "Option::is_none")]
    threshold: Option<f64>,
    /// Whether both surfaces are within the threshold or the bands; absent without either.
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<Verdict>,
    /// How much lies in which tolerance band; absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    bands: Option<&'o BandReport>,
    /// What was left out of both; absent if nothing was to be. Faces keep the numbers that they have in the files.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<Rest<'o>>,
    #[serde(flatten)]
    deviation: &'o Deviation,
    timing_ms: Timing,
}

/// What was left out of each mesh.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Rest<'o> {
    a: &'o LeftOut,
    b: &'o LeftOut,
}

/// Milliseconds spent on each part, both directions together.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    read: f64,
    build: f64,
    search: f64,
    refine: f64,
    total: f64,
}
