//! The fluid and what drives it.

use super::error::FlowError;
use pompeiu_core::run::{Limits, ProgressObserver};

/// The boundary condition at the inlet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// Mean speed at the inlet in µm/s, with the profile of a long tube.
    Speed(f64),
    /// Pressure at the inlet in Pa.
    Pressure(f64),
}

/// Parameters of a flow. Pressures are given at all flat ends other than the inlet.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowParameters {
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Density in kg/m³.
    pub density: f64,
    /// The boundary condition at the inlet.
    pub drive: Drive,
    /// The sample of the inlet; by default the root's flat end.
    pub inlet: Option<i64>,
    /// Pressures at flat ends in Pa, by sample; 0 at the others.
    pub pressures: Vec<(i64, f64)>,
}

impl Default for FlowParameters {
    /// Water, driven with a mean speed of 1 µm/s.
    fn default() -> Self {
        Self {
            viscosity: 1e-3,
            density: 1000.0,
            drive: Drive::Speed(1.0),
            inlet: None,
            pressures: Vec::new(),
        }
    }
}

impl FlowParameters {
    /// Checks that parameters are in range.
    pub(super) fn check(&self) -> Result<(), FlowError> {
        for (what, value) in [("the viscosity", self.viscosity), ("the density", self.density)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(FlowError::Parameter { what, value, expected: "above 0" });
            }
        }
        let driven = match self.drive {
            Drive::Speed(value) => ("the mean speed at the inlet", value),
            Drive::Pressure(value) => ("the pressure at the inlet", value),
        };
        let named = self.pressures.iter().map(|&(_, value)| ("a pressure at a flat end", value));
        for (what, value) in named.chain([driven]) {
            if !value.is_finite() {
                return Err(FlowError::Parameter { what, value, expected: "a number" });
            }
        }
        Ok(())
    }

    /// Kinematic viscosity in µm²/s.
    pub fn kinematic_viscosity(&self) -> f64 {
        self.viscosity / self.density * 1e12
    }
}

/// Options of a flow.
#[derive(Clone)]
pub struct FlowOptions<'o> {
    /// Parts of each patch along each edge: 1 to 4.
    pub elements: usize,
    /// Limits on time and memory.
    pub limits: Limits,
    /// Receives the number of completed Newton steps.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl Default for FlowOptions<'_> {
    fn default() -> Self {
        Self { elements: 1, limits: Limits::default(), progress: None }
    }
}
