//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{Bounds, MeshFile, milliseconds};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let (found, distance) = (&outcome.found, &outcome.found.distance);
    let report = Report {
        input: MeshFile::from(&outcome.input),
        output: MeshFile::from(&outcome.output),
        within: outcome.within,
        distance: distance.distance.into(),
        input_to_output: distance.a_to_b.distance.into(),
        output_to_input: distance.b_to_a.distance.into(),
        collapses: found.collapses,
        stop: found.stop.name(),
        timing_ms: Timing {
            collapse: milliseconds(found.timing.collapse),
            distance: milliseconds(found.timing.distance),
            total: milliseconds(outcome.total),
        },
    };
    Ok(serde_json::to_string(&report)? + "\n")
}

#[derive(Serialize)]
struct Report<'o> {
    input: MeshFile<'o>,
    output: MeshFile<'o>,
    /// The distance asked for; null where a number of faces was.
    within: Option<f64>,
    distance: Bounds,
    input_to_output: Bounds,
    output_to_input: Bounds,
    collapses: usize,
    stop: &'static str,
    timing_ms: Timing,
}

#[derive(Serialize)]
struct Timing {
    collapse: f64,
    distance: f64,
    total: f64,
}
