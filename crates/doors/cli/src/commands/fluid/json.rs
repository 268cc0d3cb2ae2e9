//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::core::run::StopReason;
use pompeiu::fluid::{FluidStep, SchemeReport};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let timing = outcome.timing;
    let steps = outcome.steps.len().saturating_sub(1).max(1) as f64;
    let per_step = |span| milliseconds(span) / steps;
    line(&Json {
        input: &outcome.input,
        stop: outcome.stop,
        steps: &outcome.steps,
        scheme: &outcome.scheme,
        timing_ms: Timing {
            factor: milliseconds(timing.factor),
            per_step: PerStep {
                diffuse: per_step(timing.diffuse),
                advect: per_step(timing.advect),
                project: per_step(timing.project),
            },
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu fluid --json`. Lengths are in the unit of the file, times in that of the scene.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Fluid"))]
pub(crate) struct Json<'o> {
    /// The mesh; in the square a vertex for each cell.
    input: &'o File,
    /// Why it ended: steps, time or cancelled.
    stop: StopReason,
    /// The flow at first and after each step.
    steps: &'o [FluidStep],
    scheme: &'o SchemeReport,
    timing_ms: Timing,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    factor: f64,
    per_step: PerStep,
    total: f64,
}

/// Milliseconds of a step, on average.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct PerStep {
    /// Forces, viscosity.
    diffuse: f64,
    /// Advection of velocity and densities, sources and diffusion of densities.
    advect: f64,
    /// Stream function, velocity, and what is measured.
    project: f64,
}
