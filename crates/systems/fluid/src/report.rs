//! Quantities measured at each step.

use crate::options::{
    Correction, Diffusion, FluidOptions, Integrator, TimeStep, Transport, ViscosityModel, Wall,
};
use crate::square::{SquareOptions, SquareScheme};
use std::time::Duration;

/// Measured quantities after a step. Lengths and times are in the units of the input.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FluidStep {
    /// Time since the beginning.
    pub time: f64,
    /// Kinetic energy for unit mass per area, `½ ∫ |u|²`.
    pub energy: f64,
    /// `½ ∫ ω²`, with ω the vorticity.
    pub enstrophy: f64,
    /// `∫ ω`; zero up to rounding on a closed surface.
    pub total_vorticity: f64,
    /// Discrete divergence: the imbalance of flow at edges, as the root of the sum of squares relative to the norm of the velocity.
    /// Zero up to rounding.
    pub divergence: f64,
    /// The integral of each density.
    pub mass: Vec<f64>,
    /// The least and the greatest value of each density.
    pub range: Vec<[f64; 2]>,
    /// The coefficients of the harmonic fields.
    pub harmonic: Vec<f64>,
    /// The greatest speed of a face.
    pub max_speed: f64,
    /// The Courant number: the greatest share of its content that flows out of a dual cell in the step.
    pub cfl: f64,
    /// Substeps of the advection of the velocity.
    pub substeps: usize,
    /// Whether the viscous step would have increased the energy, so that the velocity was scaled down.
    pub energy_guarded: bool,
}

/// The least and the greatest of some values.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [if x < least { x } else { least }, if x > most { x } else { most }]
    })
}

/// The scheme of a simulation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SchemeReport {
    /// The discretisation of the velocity and its advection: vorticity, any-step, faces, crouzeix-raviart; in the square mac, stam.
    pub name: &'static str,
    /// Time integration, unless advection is semi-Lagrangian.
    pub integrator: Option<Integrator>,
    /// Correction of semi-Lagrangian advection, if there is any.
    pub correction: Option<Correction>,
    /// The edge weights for diffusion of quantities on faces, if there are any.
    pub diffusion: Option<Diffusion>,
    /// Length of a step; for adaptive steps the longest.
    pub time_step: f64,
    /// The largest Courant number for adaptive steps.
    pub cfl: Option<f64>,
    /// Kinematic viscosity.
    pub viscosity: f64,
    /// The Laplacian of the viscous force.
    pub viscosity_model: ViscosityModel,
    /// The largest angle defect of a vertex, in radians, that the viscous forces take for curvature; null if there is no
    /// limit. On faces that do not resolve the curvature viscosity would otherwise add energy.
    pub curvature_limit: Option<f64>,
    /// Number of vertices whose angle defects are larger.
    pub limited_vertices: usize,
    /// The condition for a viscous flow at the boundary.
    pub wall: Wall,
    /// The scheme that transports densities.
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
            curvature_limit: None,
            limited_vertices: 0,
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
            curvature_limit: None,
            limited_vertices: 0,
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
    /// Factorizations and harmonic fields.
    pub factor: Duration,
    /// Forces, viscosity and the diffusion of densities.
    pub diffuse: Duration,
    /// Advection of velocity and densities, with the solves that it needs.
    pub advect: Duration,
    /// Stream function, velocity and measured quantities.
    pub project: Duration,
}
