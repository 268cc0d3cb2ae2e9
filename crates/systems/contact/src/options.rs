//! Options of a simulation.

use crate::ContactError;
use glam::DVec3;

/// The sum of barriers that stands for a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum PairSet {
    /// Inclusion and exclusion for points: faces less inner edges plus inner vertices, so that a flat surface pushes a point once,
    /// however it is divided. Pairs of edges count as much as their faces are bent at them when a step begins.
    #[default]
    Exclusive,
    /// All pairs of points with triangles and of edges with edges. Inner edges of a flat surface push sideways.
    Plain,
}

/// The projection of second derivatives of barriers to positive semi-definite matrices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Projection {
    /// Only the part along the normal, of rank one.
    #[default]
    Normal,
    /// The nearest positive semi-definite matrix, from an eigenproblem of size five.
    Exact,
}

/// The time integrator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Integrator {
    /// Implicit Euler: first order, damps oscillations.
    #[default]
    Euler,
    /// The backward differentiation formula of second order.
    Bdf2,
}

/// When the exact test for intersections runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Check {
    /// After each step.
    #[default]
    Every,
    /// When asked for: [`Simulation::certify`](crate::Simulation::certify).
    Last,
    /// Not at all, but for the start.
    Never,
}

/// Options of a [`Simulation`](crate::Simulation). Lengths are in the unit of the bodies, times in any, masses in any.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactOptions {
    /// Length of a step, h.
    pub time_step: f64,
    /// The acceleration of gravity.
    pub gravity: DVec3,
    /// The distance below which surfaces push each other, d̂.
    pub distance: f64,
    /// Coefficient of friction, μ.
    pub friction: f64,
    /// The speed below which surfaces stick.
    pub sticking_speed: f64,
    /// The stiffness κ of barriers. If none is given it is chosen from the weight, and doubled where surfaces come too close.
    pub stiffness: Option<f64>,
    /// Newton's method ends when no vertex would move faster than this.
    pub tolerance: f64,
    /// Newton steps at most.
    pub most_iterations: usize,
    /// The pairs whose barriers are added.
    pub pairs: PairSet,
    /// The projection of second derivatives to positive semi-definite matrices.
    pub projection: Projection,
    /// The time integrator.
    pub integrator: Integrator,
    /// When the exact test runs.
    pub check: Check,
}

impl Check {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Every => "every",
            Self::Last => "last",
            Self::Never => "never",
        }
    }
}

impl ContactOptions {
    /// Gravity along −z of 9.81, no friction, for bodies of this size.
    pub fn new(time_step: f64, size: f64) -> Self {
        Self {
            time_step,
            gravity: DVec3::new(0.0, 0.0, -9.81),
            distance: 1e-3 * size,
            friction: 0.0,
            sticking_speed: 1e-3 * size,
            stiffness: None,
            tolerance: 1e-3 * size,
            most_iterations: 200,
            pairs: PairSet::default(),
            projection: Projection::default(),
            integrator: Integrator::default(),
            check: Check::default(),
        }
    }

    pub(crate) fn check(&self) -> Result<(), ContactError> {
        for (what, value, positive) in [
            ("time step", self.time_step, true),
            ("distance of contact", self.distance, true),
            ("coefficient of friction", self.friction, false),
            ("sticking speed", self.sticking_speed, true),
            ("tolerance", self.tolerance, true),
            ("stiffness of barriers", self.stiffness.unwrap_or(1.0), true),
        ] {
            let expected = if positive { "above 0" } else { "not negative" };
            if !(value.is_finite() && (value > 0.0 || (value == 0.0 && !positive))) {
                return Err(ContactError::Parameter { what, value, expected });
            }
        }
        if !self.gravity.is_finite() {
            let (what, value, expected) = ("gravity", self.gravity.length(), "a vector of numbers");
            return Err(ContactError::Parameter { what, value, expected });
        }
        Ok(())
    }
}
