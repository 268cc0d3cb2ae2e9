//! Parameters of transport.

use super::error::TransportError;
use super::state::TransportState;
use crate::{FlowParameters, Side};
use pompeiu_core::run::{Limits, ProgressObserver};

/// Parameters of freely diffusing material, n₀, and of material on motors that move away from the inlet, n₊, and towards it, n₋. In
/// micrometres and seconds.
///
/// # Definition
/// `∂n₀/∂t = D ∇²n₀ − (k₊ + k₋) n₀ + k′₊ n₊ + k′₋ n₋` and `∂n±/∂t + ∇·(v± n±) = k± n₀ − k′± n±`.
/// # Source
/// The model of motors that `li_neurite_2019` uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// D, in µm²/s.
    pub diffusion: f64,
    /// v₊: mean speed at the inlet away from it, in µm/s, at least 0.
    pub speed_plus: f64,
    /// v₋: mean speed at the inlet towards it, in µm/s, at least 0.
    pub speed_minus: f64,
    /// k₊: rate of attachment to motors away from the inlet, in 1/s.
    pub attach_plus: f64,
    /// k₋: rate of attachment to motors towards the inlet.
    pub attach_minus: f64,
    /// k′₊: rate of detachment from motors away from the inlet, in 1/s.
    pub detach_plus: f64,
    /// k′₋: rate of detachment from motors towards the inlet.
    pub detach_minus: f64,
    /// Free concentration at the inlet; `None` if the inlet is closed to free material.
    pub inlet_free: Option<f64>,
    /// Concentration on motors entering at the inlet.
    pub inlet_plus: f64,
    /// Concentration on motors entering at the tips.
    pub tips_minus: f64,
    /// Free concentration at the tips; `None` if they are closed to free material.
    pub tips_free: Option<f64>,
    /// Initial concentrations n₀, n₊, n₋.
    pub initial: [f64; 3],
    /// Length of a step in seconds.
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// The time scheme.
    pub scheme: TimeScheme,
    /// The sample of the inlet, by its number in the file; by default the root's flat end.
    pub inlet: Option<i64>,
    /// For a mesh without labelled ends, the sides of the bounding box that are ends: the inlet first.
    pub sides: Vec<Side>,
    /// The fluid, if its flow is computed.
    pub flow: FlowParameters,
}

/// Time schemes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeScheme {
    /// Backward Euler.
    #[default]
    First,
    /// Two stages of second order, limited where a concentration would become negative.
    Second,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            diffusion: 1.0,
            speed_plus: 1.0,
            speed_minus: 0.0,
            attach_plus: 1.0,
            attach_minus: 0.0,
            detach_plus: 0.1,
            detach_minus: 0.0,
            inlet_free: Some(1.0),
            inlet_plus: 2.0,
            tips_minus: 0.0,
            tips_free: None,
            initial: [0.0; 3],
            step: 0.1,
            steps: 100,
            scheme: TimeScheme::First,
            inlet: None,
            sides: Vec::new(),
            flow: FlowParameters::default(),
        }
    }
}

/// Largest number of steps.
const MOST_STEPS: usize = 10_000_000;

impl Parameters {
    /// All parameters except the number of steps, in one line: identifies the run of a state.
    pub fn line(&self) -> String {
        format!("{:?}", Self { steps: 1, ..self.clone() })
    }

    /// Checks that the parameters are valid.
    ///
    /// # Errors
    /// [`TransportError::Parameter`].
    pub fn check(&self) -> Result<(), TransportError> {
        let list = [
            ("the diffusivity", self.diffusion),
            ("the speed away from the inlet", self.speed_plus),
            ("the speed towards the inlet", self.speed_minus),
            ("the rate of attachment k+", self.attach_plus),
            ("the rate of attachment k-", self.attach_minus),
            ("the rate of detachment k'+", self.detach_plus),
            ("the rate of detachment k'-", self.detach_minus),
            ("the free concentration at the inlet", self.inlet_free.unwrap_or(0.0)),
            ("the attached concentration at the inlet", self.inlet_plus),
            ("the attached concentration at the tips", self.tips_minus),
            ("the free concentration at the tips", self.tips_free.unwrap_or(0.0)),
            ("the free concentration in the beginning", self.initial[0]),
            ("the concentration on motors away from the inlet in the beginning", self.initial[1]),
            ("the concentration on motors towards the inlet in the beginning", self.initial[2]),
        ];
        for (what, value) in list {
            if !(value.is_finite() && value >= 0.0) {
                return Err(TransportError::Parameter { what, value, expected: "at least 0" });
            }
        }
        if !(self.step.is_finite() && self.step > 0.0) {
            return Err(TransportError::Parameter {
                what: "the step",
                value: self.step,
                expected: "above 0",
            });
        }
        if !(1..=MOST_STEPS).contains(&self.steps) {
            let value = self.steps as f64;
            return Err(TransportError::Parameter {
                what: "the number of steps",
                value,
                expected: "1 to 10 million",
            });
        }
        Ok(())
    }
}

/// Options of transport.
#[derive(Clone, Default)]
pub struct TransportOptions<'o> {
    /// Limits on time and memory. When time runs out, the completed steps are returned.
    pub limits: Limits,
    /// Receives the number of completed steps.
    pub progress: Option<&'o dyn ProgressObserver>,
    /// The state to resume from, of a run with the same mesh and parameters that ended early.
    pub resume: Option<&'o TransportState>,
}
