//! Measured quantities of each window.

use crate::AddedMass;

/// A converged time window.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WindowReport {
    /// Number of solves of both solvers, including the verifying one and those of failed attempts.
    pub solves: usize,
    /// Number of failed attempts.
    pub failed_attempts: usize,
    /// The damping factor of the residual that the model does not explain.
    pub damping: f64,
    /// The relative change of the interface in the last solve.
    pub change: f64,
    /// Number of columns of the last model.
    pub columns: usize,
    /// Number of columns that it dropped.
    pub dropped: usize,
    /// The added-mass number estimated from the solves of this window.
    pub added_mass: Option<AddedMass>,
    /// The constant that was added to the pressure of an enclosed region.
    pub pressure_constant: Option<f64>,
}
