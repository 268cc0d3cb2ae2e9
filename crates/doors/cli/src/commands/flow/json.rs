//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::flow::{Change, Cone, Discs, FlowRecord, FlowStop, GradientNorm, Neck, Stability};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let flow = &outcome.flow;
    line(&Json {
        input: &outcome.input,
        output: &outcome.output,
        stop: flow.stop,
        steps: flow.steps,
        area: flow.area,
        volume: flow.volume,
        gradient: flow.gradient,
        pressure: flow.pressure,
        stability: flow.stability,
        discs: flow.discs,
        cone: flow.cone,
        neck: flow.neck,
        history: &flow.history,
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
    /// Why it ended.
    stop: FlowStop,
    /// Number of steps.
    steps: usize,
    area: Change,
    /// The enclosed volume, or that of the cone from the origin over a surface with a fixed boundary.
    volume: Option<Change>,
    /// The gradient of the area at the end.
    gradient: GradientNorm,
    /// By how much the area changes with the volume, where that is kept.
    pressure: Option<f64>,
    /// Whether a stationary surface is a local minimum.
    stability: Option<Stability>,
    /// The discs that span two boundary loops one by one.
    discs: Option<Discs>,
    /// A cone which shows that no connected minimal surface spans two boundary loops.
    cone: Option<Cone>,
    /// The neck that pinches off.
    neck: Option<Neck>,
    /// Every step, the surface given first.
    history: &'o [FlowRecord],
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
