//! What a flow did.

use crate::{FluidStep, FluidTiming, SchemeReport};
use pompeiu_core::request::{Conclusion, Report};
use pompeiu_core::run::StopReason;
use std::time::Duration;

/// A flow: what was measured at first and after each step. Lengths are in the unit of the mesh, times in that of the options.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FluidReport {
    /// The flow at first and after each step.
    pub steps: Vec<FluidStep>,
    /// Steps that were asked for.
    pub asked: usize,
    /// The method that computes the flow.
    pub scheme: SchemeReport,
    /// The change of the initial velocity; null where none was given.
    pub start: Option<StartReport>,
    /// Time spent on each part.
    #[serde(rename = "timing_ms")]
    pub timing: TimingReport,
    /// The reason for which the computation ended.
    #[serde(skip)]
    pub stop: StopReason,
}

/// The change of an initial velocity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StartReport {
    /// Whether its vectors are tangent to rounding.
    pub is_tangent: bool,
    /// The length of the largest part along a normal, which is left out.
    pub normal_part: f64,
    /// The share of its energy that is divergence, which is taken off.
    pub divergence: f64,
}

/// Time by the clock; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimingReport {
    /// Factorizations and harmonic fields.
    pub factor: f64,
    /// Each step, on average.
    pub per_step: StepTiming,
}

/// Milliseconds of a step, on average.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepTiming {
    /// Forces, viscosity.
    pub diffuse: f64,
    /// Advection of velocity and densities, sources and diffusion of densities.
    pub advect: f64,
    /// Stream function, velocity, and what is measured.
    pub project: f64,
}

impl TimingReport {
    /// The times of so many steps.
    pub(super) fn new(timing: FluidTiming, steps: usize) -> Self {
        let milliseconds = |span: Duration| span.as_nanos() as f64 / 1e6;
        let each = |span| milliseconds(span) / steps.max(1) as f64;
        Self {
            factor: milliseconds(timing.factor),
            per_step: StepTiming {
                diffuse: each(timing.diffuse),
                advect: each(timing.advect),
                project: each(timing.project),
            },
        }
    }
}

impl Report for FluidReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    fn conclusion(&self) -> Conclusion {
        if self.steps.len() > self.asked { Conclusion::AsAsked } else { Conclusion::Incomplete }
    }
}
