//! What is measured, step by step.

use crate::options::{
    Correction, Diffusion, FluidOptions, Integrator, TimeStep, Transport, ViscosityModel, Wall,
};
use crate::square::{SquareOptions, SquareScheme};
use std::time::Duration;

/// A flow after a step. Lengths and times are in the units of the input.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FluidStep {
    /// Time since the beginning.
    pub time: f64,
    /// Kinetic energy of a unit of mass per area, `½ ∫ |u|²`.
    pub energy: f64,
    /// `½ ∫ ω²`, with ω the vorticity.
    pub enstrophy: f64,
    /// `∫ ω`; zero on a closed surface, but for rounding.
    pub total_vorticity: f64,
    /// How much more flows into edges than out of them: the root of the sum of squares over the norm of the velocity. Rounding is all
    /// there should be.
    pub divergence: f64,
    /// The integral of each density.
    pub mass: Vec<f64>,
    /// The least and the greatest value of each density.
    pub range: Vec<[f64; 2]>,
    /// The coefficients of the harmonic fields.
    pub harmonic: Vec<f64>,
    /// The greatest speed of a face.
    pub max_speed: f64,
    /// The greatest share of its content that flows out of a dual cell in the step.
    pub cfl: f64,
    /// Substeps of the advection of the velocity.
    pub substeps: usize,
    /// Whether viscosity alone would have added energy, so that the velocity was scaled down.
    pub energy_guarded: bool,
}

/// The least and the greatest of some values.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [if x < least { x } else { least }, if x > most { x } else { most }]
    })
}

/// How a flow was computed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SchemeReport {
    /// How the velocity is stored and advected: vorticity, any-step, faces, crouzeix-raviart; in the square mac, stam.
    pub name: &'static str,
    /// How it moves on in time, where it is not traced back.
    pub integrator: Option<Integrator>,
    /// What is done about the blur of what is traced back, where anything is.
    pub correction: Option<Correction>,
    /// By which weights what is stored on faces diffuses, where anything is.
    pub diffusion: Option<Diffusion>,
    /// Length of a step, the longest where it is chosen.
    pub time_step: f64,
    /// The bound of the Courant number by which steps are chosen.
    pub cfl: Option<f64>,
    /// Kinematic viscosity.
    pub viscosity: f64,
    /// Which Laplacian it goes with.
    pub viscosity_model: ViscosityModel,
    /// What a viscous flow does at the boundary.
    pub wall: Wall,
    /// How densities are carried.
    pub transport: Transport,
    /// The names of the densities, in the order of their masses.
    pub densities: Vec<String>,
    /// Number of harmonic fields.
    pub harmonic_fields: usize,
}

impl SchemeReport {
    pub(crate) fn of(options: &FluidOptions, harmonic_fields: usize) -> Self {
        Self {
            name: options.scheme.name(),
            integrator: options.scheme.is_eulerian().then_some(options.integrator),
            correction: options.traces_back().then_some(options.correction),
            diffusion: options.on_faces().then_some(options.diffusion),
            time_step: options.longest_step(),
            cfl: match options.time_step {
                TimeStep::Fixed(_) => None,
                TimeStep::Cfl { number, .. } => Some(number),
            },
            viscosity: options.viscosity,
            viscosity_model: options.viscosity_model,
            wall: options.wall,
            transport: options.transport,
            densities: options.densities.iter().map(|density| density.name.clone()).collect(),
            harmonic_fields,
        }
    }

    pub(crate) fn of_square(options: &SquareOptions) -> Self {
        let (name, transport) = match options.scheme {
            SquareScheme::Mac => ("mac", Transport::FluxCorrected),
            SquareScheme::Stam { .. } => ("stam", Transport::SemiLagrangian),
        };
        Self {
            name,
            integrator: None,
            correction: None,
            diffusion: None,
            time_step: options.time_step,
            cfl: None,
            viscosity: options.viscosity,
            viscosity_model: ViscosityModel::default(),
            wall: options.wall,
            transport,
            densities: options.densities.iter().map(|density| density.name.clone()).collect(),
            harmonic_fields: 0,
        }
    }
}

/// Wall-clock times of a simulation, all steps together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FluidTiming {
    /// Factoring, harmonic fields.
    pub factor: Duration,
    /// Forces, viscosity and the diffusion of densities.
    pub diffuse: Duration,
    /// Advection of velocity and densities, with the solves that it needs.
    pub advect: Duration,
    /// Stream function, velocity and what is measured of them.
    pub project: Duration,
}
