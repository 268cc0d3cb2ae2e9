//! A column of fluid that moves a piston on a spring: the smallest problem with all difficulties of coupling.
//!
//! # Definition
//! `m_s x″ + k x = −p A` and `p A = m_f x″`, with A = 1. Together `(m_s + m_f) x″ + k x = 0`, of angular frequency
//! `√(k / (m_s + m_f))`. With backward Euler, fixed-point iteration relaxed by ω multiplies errors by `1 − ω (1 + μ)`,
//! `μ = m_f / (m_s + k Δt²)`.

use crate::{CouplingError, Refusal, Subproblem};

/// Time integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum TimeRule {
    /// First order; dissipates the energy of oscillations.
    #[default]
    BackwardEuler,
    /// Newmark's method with ¼ and ½: second order, conserves the energy of linear oscillations.
    Trapezoidal,
}

impl TimeRule {
    /// The one of a name: `backward-euler`, `trapezoidal`.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "backward-euler" => Some(Self::BackwardEuler),
            "trapezoidal" => Some(Self::Trapezoidal),
            _ => None,
        }
    }
}

/// A piston.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PistonOptions {
    /// Mass of the piston, `m_s`.
    pub mass: f64,
    /// Stiffness of its spring, k.
    pub stiffness: f64,
    /// Mass of the column of fluid, `m_f`.
    pub fluid_mass: f64,
    /// Length of a step.
    pub time_step: f64,
    /// The initial position, at rest.
    pub start: f64,
    /// Time integration.
    pub rule: TimeRule,
}

impl Default for PistonOptions {
    fn default() -> Self {
        let rule = TimeRule::default();
        Self { mass: 1.0, stiffness: 1.0, fluid_mass: 1.0, time_step: 0.01, start: 1.0, rule }
    }
}

/// A piston with valid parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piston {
    options: PistonOptions,
}

/// Position, velocity and acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
struct State {
    x: f64,
    v: f64,
    a: f64,
}

/// The column of fluid or the piston: from position to pressure, or the reverse.
#[derive(Clone, Debug)]
pub struct PistonHalf {
    options: PistonOptions,
    is_fluid: bool,
    accepted: State,
    solved: State,
}

impl Piston {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`CouplingError::Parameter`].
    pub fn new(options: PistonOptions) -> Result<Self, CouplingError> {
        let PistonOptions { mass, stiffness, fluid_mass, time_step, start, .. } = options;
        for (what, value, positive) in [
            ("mass of the piston", mass, true),
            ("stiffness of the spring", stiffness, false),
            ("mass of the fluid", fluid_mass, false),
            ("time step", time_step, true),
        ] {
            let expected = if positive { "above 0" } else { "not negative" };
            if !(value.is_finite() && (value > 0.0 || (value == 0.0 && !positive))) {
                return Err(CouplingError::Parameter { what, value, expected });
            }
        }
        if !start.is_finite() {
            let (what, expected) = ("start of the piston", "a number");
            return Err(CouplingError::Parameter { what, value: start, expected });
        }
        Ok(Self { options })
    }

    /// The initial position.
    pub fn start(&self) -> f64 {
        self.options.start
    }

    /// The initial acceleration of the coupled system.
    fn first(&self) -> State {
        let PistonOptions { mass, fluid_mass, stiffness, start, .. } = self.options;
        State { x: start, v: 0.0, a: -stiffness * start / (mass + fluid_mass) }
    }

    /// The column of fluid: positions in, pressures out.
    pub fn fluid(&self) -> PistonHalf {
        self.half(true)
    }

    /// The piston with its spring: pressures in, positions out.
    pub fn solid(&self) -> PistonHalf {
        self.half(false)
    }

    fn half(&self, is_fluid: bool) -> PistonHalf {
        let state = self.first();
        PistonHalf { options: self.options, is_fluid, accepted: state, solved: state }
    }

    /// The added-mass number of a step.
    pub fn added_mass(&self) -> f64 {
        let PistonOptions { mass, stiffness, fluid_mass, .. } = self.options;
        fluid_mass / (mass + stiffness / self.options.inertia())
    }

    /// Positions after each step of the monolithic solution.
    pub fn monolithic(&self, steps: usize) -> Vec<f64> {
        let PistonOptions { mass, stiffness, fluid_mass, .. } = self.options;
        let mut state = self.first();
        (0..steps)
            .map(|_| {
                let known = state.predicted(&self.options);
                let mass = mass + fluid_mass;
                let x = mass * known / (mass * self.options.inertia() + stiffness);
                state = state.moved(x, &self.options);
                x
            })
            .collect()
    }
}

impl PistonOptions {
    /// Derivative of the acceleration by the displacement.
    fn inertia(&self) -> f64 {
        let square = self.time_step * self.time_step;
        match self.rule {
            TimeRule::BackwardEuler => 1.0 / square,
            TimeRule::Trapezoidal => 4.0 / square,
        }
    }
}

impl State {
    /// The negated part of the acceleration that depends on the previous state.
    fn predicted(&self, options: &PistonOptions) -> f64 {
        let dt = options.time_step;
        match options.rule {
            TimeRule::BackwardEuler => (self.x + dt * self.v) * options.inertia(),
            TimeRule::Trapezoidal => (self.x + dt * self.v) * options.inertia() + self.a,
        }
    }

    fn moved(&self, x: f64, options: &PistonOptions) -> Self {
        let a = options.inertia() * x - self.predicted(options);
        let v = match options.rule {
            TimeRule::BackwardEuler => (x - self.x) / options.time_step,
            TimeRule::Trapezoidal => self.v + 0.5 * options.time_step * (self.a + a),
        };
        Self { x, v, a }
    }
}

impl Subproblem for PistonHalf {
    fn inputs(&self) -> usize {
        1
    }

    fn outputs(&self) -> usize {
        1
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        let (options, state) = (&self.options, &self.accepted);
        if self.is_fluid {
            self.solved = state.moved(input[0], options);
            output[0] = options.fluid_mass * self.solved.a;
        } else {
            let known = options.mass * state.predicted(options);
            let x = (known - input[0]) / (options.mass * options.inertia() + options.stiffness);
            self.solved = state.moved(x, options);
            output[0] = x;
        }
        Ok(())
    }

    fn accept(&mut self) {
        self.accepted = self.solved;
    }
}
