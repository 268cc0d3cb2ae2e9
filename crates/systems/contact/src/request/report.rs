//! What a run did.

use crate::{Check, ContactOptions, ContactStep, ContactTiming, Integrator, PairSet, Projection, Simulation};
use pompeiu_core::request::{Conclusion, Report};
use pompeiu_core::run::StopReason;

/// A run: what was measured after each step. Lengths, times and masses are in the units of the scene.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactReport {
    /// The name of the example, or "bodies".
    pub scene: String,
    /// Number of bodies.
    pub bodies: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces of surfaces.
    pub faces: usize,
    /// Number of tetrahedra.
    pub tetrahedra: usize,
    /// Steps that were asked for.
    pub asked: usize,
    /// The scheme that computes steps.
    pub scheme: ContactScheme,
    /// The weight of what moves.
    pub weight: [f64; 3],
    /// The start; its forces are not measured.
    pub start: ContactStep,
    /// The result of the exact test.
    pub certificate: Certificate,
    /// Each step.
    pub steps: Vec<ContactStep>,
    /// The reason for which a step could not be computed; null where all could.
    pub failure: Option<String>,
    /// Time spent on parts of the steps.
    #[serde(rename = "timing_ms")]
    pub timing: ContactTiming,
    /// The reason for which the computation ended.
    #[serde(skip)]
    pub stop: StopReason,
}

/// The result of the exact test, which shares no arithmetic with the simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Certificate {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps after which the test ran; the start is always tested.
    pub tested: usize,
    /// Pairs of faces that intersect after these steps.
    pub intersecting: usize,
}

/// The scheme that computes steps.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactScheme {
    /// Length of a step.
    pub time_step: f64,
    /// The acceleration of gravity.
    pub gravity: [f64; 3],
    /// The distance below which surfaces push each other.
    pub distance: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// The speed below which surfaces stick.
    pub sticking_speed: f64,
    /// The stiffness of barriers if it is fixed; null where it is chosen.
    pub stiffness: Option<f64>,
    /// Newton's method ends when no vertex would move faster than this.
    pub tolerance: f64,
    /// The pairs whose barriers are added.
    pub pairs: PairSet,
    /// The projection of second derivatives to positive semi-definite matrices.
    pub projection: Projection,
    /// The time integrator.
    pub integrator: Integrator,
    /// When the exact test runs.
    pub check: Check,
}

impl ContactScheme {
    pub(super) fn new(options: &ContactOptions) -> Self {
        Self {
            time_step: options.time_step,
            gravity: options.gravity.to_array(),
            distance: options.distance,
            friction: options.friction,
            sticking_speed: options.sticking_speed,
            stiffness: options.stiffness,
            tolerance: options.tolerance,
            pairs: options.pairs,
            projection: options.projection,
            integrator: options.integrator,
            check: options.check,
        }
    }
}

impl Certificate {
    /// The certificate in words.
    pub fn sentence(&self) -> String {
        let Self { steps, tested, intersecting } = *self;
        if tested == 0 {
            return "not tested after the start".to_owned();
        }
        let pairs = if intersecting == 1 { "pair" } else { "pairs" };
        format!("{intersecting} intersecting {pairs} in {tested} of {steps} steps, exact")
    }
}

impl ContactReport {
    /// The least gap of all steps.
    pub fn least_gap(&self) -> Option<f64> {
        self.steps.iter().filter_map(|step| step.least_gap).reduce(f64::min)
    }

    /// Newton iterations of all steps.
    pub fn iterations(&self) -> usize {
        self.steps.iter().map(|step| step.iterations).sum()
    }

    /// The start of a report, without steps.
    pub(super) fn new(scene: &str, bodies: usize, asked: usize, simulation: &Simulation) -> Self {
        let tetrahedra = simulation.bodies().tetrahedra.len();
        Self {
            scene: scene.to_owned(),
            bodies,
            vertices: simulation.positions().len(),
            faces: simulation.faces().len(),
            tetrahedra,
            asked,
            scheme: ContactScheme::new(simulation.options()),
            weight: simulation.weight().to_array(),
            start: simulation.measure(),
            certificate: Certificate::default(),
            steps: Vec::new(),
            failure: None,
            timing: ContactTiming::default(),
            stop: StopReason::Steps,
        }
    }
}

impl Report for ContactReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    fn conclusion(&self) -> Conclusion {
        if self.certificate.intersecting > 0 {
            Conclusion::Refuted
        } else if self.failure.is_none() && self.steps.len() >= self.asked {
            Conclusion::AsAsked
        } else {
            Conclusion::Incomplete
        }
    }
}
