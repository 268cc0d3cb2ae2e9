//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::core::mesh::Rounding;
use pompeiu::core::run::StopReason;
use pompeiu::hausdorff::Enclosure;
use pompeiu::remesh::{IntersectionCount, Quality};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let found = &outcome.found;
    let distance = found.distance.as_ref();
    line(&Json {
        input: &outcome.input,
        output: &outcome.output,
        edge_length: outcome.edge_length,
        chord_height: outcome.chord_height,
        within: outcome.within,
        before: found.before,
        after: found.after,
        distance: distance.map(|d| d.distance),
        input_to_output: distance.map(|d| d.a_to_b.distance),
        output_to_input: distance.map(|d| d.b_to_a.distance),
        rounding: found.rounding,
        intersections: found.intersections,
        iterations: found.iterations,
        stop: found.stop,
        timing_ms: Timing {
            remesh: milliseconds(found.timing.remesh),
            distance: milliseconds(found.timing.distance),
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu remesh --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Remesh"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    output: &'o File,
    /// The length of edges asked for; null where a chord height was.
    edge_length: Option<f64>,
    /// The chord height asked for; null where a length of edges was.
    chord_height: Option<f64>,
    /// The distance asked for; null without.
    within: Option<f64>,
    /// The triangles of the input.
    before: Quality,
    /// The triangles of the output.
    after: Quality,
    /// The Pompeiu–Hausdorff distance of input and output.
    distance: Option<Enclosure>,
    /// How far the input is from the output.
    input_to_output: Option<Enclosure>,
    /// How far the output is from the input.
    output_to_input: Option<Enclosure>,
    /// What rounding to the coordinates of the output does to the input.
    rounding: Rounding,
    /// How many pairs of faces of the output intersect; null where they were not looked for.
    intersections: Option<IntersectionCount>,
    /// Number of rounds of splits, collapses, flips and moves.
    iterations: usize,
    /// Why it ended.
    stop: StopReason,
    timing_ms: Timing,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    remesh: f64,
    distance: f64,
    total: f64,
}
