//! What is measured, window by window.

use crate::AddedMass;

/// A window in time on which the solvers agree.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WindowReport {
    /// Solves of both solvers, the one that verifies and those of attempts that failed among them.
    pub solves: usize,
    /// Attempts that failed before.
    pub failed_attempts: usize,
    /// The part that was taken of what the model does not explain.
    pub damping: f64,
    /// The relative change of the interface in the last solve.
    pub change: f64,
    /// Columns of the last model.
    pub columns: usize,
    /// Columns that it left out.
    pub dropped: usize,
    /// What the solves of this window say about plain iteration.
    pub added_mass: Option<AddedMass>,
    /// The constant that was added to the pressure of an enclosed region.
    pub pressure_constant: Option<f64>,
}
