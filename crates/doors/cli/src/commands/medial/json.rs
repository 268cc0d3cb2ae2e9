//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::core::run::StopReason;
use pompeiu::flatten::{Ball, Deviation};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let medial = &outcome.medial;
    line(&Json {
        input: &outcome.input,
        balls: &medial.balls,
        edges: &medial.edges,
        overlaps: medial.overlaps(),
        shrunk: medial.shrunk,
        deviation: &medial.deviation,
        stop: medial.stop,
        timing_ms: Timing { medial: milliseconds(medial.time), total: milliseconds(outcome.total) },
    })
}

/// The answer of `pompeiu medial --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Medial"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    balls: &'o [Ball],
    /// Pairs of balls that lie beside each other along the medial axis, counted from 0.
    edges: &'o [[u32; 2]],
    /// Pairs of balls that overlap.
    overlaps: Vec<[u32; 2]>,
    /// Balls that were shrunk from points of the surface, before they were replaced by fewer ones.
    shrunk: usize,
    deviation: &'o Deviation,
    stop: StopReason,
    timing_ms: Timing,
}

/// Milliseconds.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "MedialTiming"))]
struct Timing {
    /// Finding and measuring the balls.
    medial: f64,
    /// From reading to the result.
    total: f64,
}
