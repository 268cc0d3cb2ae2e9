//! Where a fluid flows: on a surface, or in the square.

use super::{CheckpointError, Stored};
use crate::square::Square;
use crate::{FluidError, FluidStep, FluidTiming, SchemeReport, Simulation};
use pompeiu_surface::EmbeddedSurface;

/// A simulation, wherever it is.
pub enum Stage<'s> {
    /// On a surface.
    Surface(Box<Simulation<'s>>, &'s EmbeddedSurface),
    /// In the square.
    Square(Box<Square>),
}

/// The same of both.
macro_rules! of_both {
    ($stage:expr, $fluid:ident => $of:expr) => {
        match $stage {
            Stage::Surface($fluid, _) => $of,
            Stage::Square($fluid) => $of,
        }
    };
}

impl Stage<'_> {
    /// Moves on by a step.
    ///
    /// # Errors
    /// [`FluidError`]; the flow is then as before.
    pub fn step(&mut self) -> Result<FluidStep, FluidError> {
        of_both!(self, fluid => fluid.step())
    }

    /// Measures the flow as it is.
    ///
    /// # Errors
    /// [`FluidError`] if a system cannot be solved.
    pub fn measure(&self) -> Result<FluidStep, FluidError> {
        of_both!(self, fluid => fluid.measure())
    }

    /// Time so far.
    pub fn time(&self) -> f64 {
        match self {
            Self::Surface(fluid, _) => fluid.state().time,
            Self::Square(square) => square.time(),
        }
    }

    /// Time by the clock spent on each part.
    pub fn timing(&self) -> FluidTiming {
        of_both!(self, fluid => fluid.timing())
    }

    /// The method that computes the flow.
    pub fn scheme(&self) -> SchemeReport {
        of_both!(self, fluid => fluid.scheme())
    }

    /// What a checkpoint holds of the state.
    pub fn store(&self) -> Stored {
        of_both!(self, fluid => fluid.store())
    }

    /// Takes a state over.
    ///
    /// # Errors
    /// [`CheckpointError`] if it does not fit.
    pub fn restore(&mut self, stored: &Stored) -> Result<(), CheckpointError> {
        of_both!(self, fluid => fluid.restore(stored))
    }
}
