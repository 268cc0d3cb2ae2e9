//! The outcome as one JSON object.

use super::appearance::Kept;
use super::run::{Outcome, within};
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::core::mesh::Rounding;
use pompeiu::core::run::StopReason;
use pompeiu::hausdorff::Enclosure;
use pompeiu::remesh::IntersectionCount;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let (output, found) = outcome.asked();
    let distance = &found.distance;
    let finer = outcome.levels[1..].iter().map(|(output, found)| Level {
        output,
        within: within(found),
        distance: found.distance.distance,
        input_to_output: found.distance.a_to_b.distance,
        output_to_input: found.distance.b_to_a.distance,
    });
    line(&Json {
        input: &outcome.input,
        output,
        within: within(found),
        distance: distance.distance,
        input_to_output: distance.a_to_b.distance,
        output_to_input: distance.b_to_a.distance,
        rounding: found.rounding,
        intersections: found.intersections,
        kept: outcome.kept,
        collapses: found.collapses,
        stop: found.stop,
        finer: finer.collect(),
        timing_ms: Timing {
            collapse: outcome.levels.iter().map(|l| milliseconds(l.1.timing.collapse)).sum(),
            distance: outcome.levels.iter().map(|l| milliseconds(l.1.timing.distance)).sum(),
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu simplify --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Simplify"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    output: &'o File,
    /// The distance asked for; null where a number of faces was.
    within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input and output.
    distance: Enclosure,
    /// How far the input is from the output.
    input_to_output: Enclosure,
    /// How far the output is from the input.
    output_to_input: Enclosure,
    /// What rounding to the coordinates of the output does to the input.
    rounding: Rounding,
    /// How many pairs of faces of the output intersect; null where they were not looked for.
    intersections: Option<IntersectionCount>,
    kept: Kept,
    /// Number of edges that were collapsed.
    collapses: usize,
    /// Why it ended.
    stop: StopReason,
    /// Other levels of detail, each finer than the one before; empty unless asked for.
    finer: Vec<Level<'o>>,
    timing_ms: Timing,
}

/// A level of detail.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Level<'o> {
    output: &'o File,
    /// The distance that it keeps; null where a number of faces was asked for.
    within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input and output.
    distance: Enclosure,
    /// How far the input is from the output.
    input_to_output: Enclosure,
    /// How far the output is from the input.
    output_to_input: Enclosure,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    collapse: f64,
    distance: f64,
    total: f64,
}
