//! What can be asked: the options of [`FluidRequest`], as every door offers them. A scene is a file of these options.

mod checkpoint;
mod error;
mod report;
mod run;
mod scene;
mod square;
mod stage;
mod surface;

pub use checkpoint::{Checkpoint, CheckpointError, Stored};
pub use error::FluidRequestError;
pub use report::{FluidReport, StartReport};
pub use run::{FluidRun, Place};
pub use scene::{Ball, DensityScene, InflowScene, LocalForce, MovingWall, Source, Vortex};
pub use stage::Stage;

use crate::square::{Edges, SquareScheme};
use crate::{Correction, Diffusion, Integrator, Scheme, Transport, ViscosityModel, Wall};
use pompeiu_core::request::{Limit, Request};
use pompeiu_operators::FieldSource;
use scene::one_or_many;
use std::path::PathBuf;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::{magnitude, tuple};
#[cfg(feature = "clap")]
use scene::{density, table};

/// Let a fluid flow on a surface, and carry things along.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FluidRequest {
    /// The unit square of N x N cells instead of a mesh.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub square: Option<usize>,
    /// The discretisation of the square: mac, stam (solved directly) or stam:SWEEPS of Gauss and Seidel.
    #[cfg_attr(feature = "clap", arg(long, value_name = "GRID"))]
    pub grid: SquareScheme,
    /// The boundary condition of the square: walls, periodic or channel:SPEED (inflow on the left).
    #[cfg_attr(feature = "clap", arg(long, value_name = "EDGES"))]
    pub edges: Edges,
    /// The velocity of the upper wall of the square, to the right.
    #[cfg_attr(feature = "clap", arg(long, allow_hyphen_values = true, value_name = "SPEED"))]
    pub lid: f64,
    /// A black and white picture of the square; what is dark is an obstacle.
    #[cfg_attr(feature = "clap", arg(long, value_name = "PICTURE"))]
    pub obstacles: Option<PathBuf>,
    /// Number of steps, from the beginning also where a state is resumed.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub steps: Option<usize>,
    /// Length of a step in time; with cfl the longest.
    #[cfg_attr(feature = "clap", arg(long, value_name = "T"))]
    pub dt: Option<f64>,
    /// Halve the step until no more than this part of what a dual cell holds flows out of it in a step.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "NUMBER"))]
    pub cfl: Option<f64>,
    /// The discretisation of the velocity and its advection.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub scheme: Scheme,
    /// The time integrator of the vorticity.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub integrator: Integrator,
    /// The correction of the numerical diffusion of semi-Lagrangian interpolation.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub correction: Correction,
    /// The edge weights by which quantities on faces diffuse; edge-length is no Laplacian and depends on the mesh.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub diffusion: Diffusion,
    /// Kinematic viscosity, squared length per time.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NU"))]
    pub viscosity: f64,
    /// The Laplacian of the viscous force.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub viscosity_model: ViscosityModel,
    /// The condition for a viscous flow at the boundary.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub wall: Wall,
    /// The scheme that transports densities.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub transport: Transport,
    /// Gravity, which acts on densities with a weight.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")
    )]
    pub gravity: Option<[f64; 3]>,
    /// Angular velocity of the whole surface: Coriolis force.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")
    )]
    pub rotation: Option<[f64; 3]>,
    /// An acceleration everywhere, along the surface.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")
    )]
    pub acceleration: Option<[f64; 3]>,
    /// Strength of vorticity confinement.
    #[cfg_attr(feature = "clap", arg(long, value_name = "STRENGTH"))]
    pub confinement: f64,
    /// The initial velocity: rotation:AXIS, random:SEED, harmonic:K or a file with a vector for each face; in the square two expressions in x and y with a semicolon between them.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FIELD", allow_hyphen_values = true))]
    pub velocity: Option<FieldSource>,
    /// The initial vorticity, an expression in x, y and z.
    #[cfg_attr(feature = "clap", arg(long, value_name = "EXPRESSION", allow_hyphen_values = true))]
    pub vorticity: Option<String>,
    /// Initial coefficients of the harmonic fields, with a vorticity.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_delimiter = ',', allow_hyphen_values = true, value_name = "C,C,…")
    )]
    pub harmonic: Vec<f64>,
    /// A density: an expression in x, y and z, or name, initial, picture, axis, diffusivity, weight and source.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = density, allow_hyphen_values = true, value_name = "EXPRESSION | NAME = VALUE, …")
    )]
    #[serde(deserialize_with = "one_or_many")]
    pub density: Vec<DensityScene>,
    /// A Gaussian of vorticity: at, radius and circulation.
    #[cfg_attr(feature = "clap", arg(long, value_parser = table::<Vortex>, value_name = "NAME = VALUE, …"))]
    #[serde(deserialize_with = "one_or_many")]
    pub vortex: Vec<Vortex>,
    /// An acceleration in a ball: at, radius and acceleration.
    #[cfg_attr(feature = "clap", arg(long, value_parser = table::<LocalForce>, value_name = "NAME = VALUE, …"))]
    #[serde(deserialize_with = "one_or_many")]
    pub force: Vec<LocalForce>,
    /// Boundary edges in a ball that move along themselves: at, radius and speed.
    #[cfg_attr(feature = "clap", arg(long, value_parser = table::<MovingWall>, value_name = "NAME = VALUE, …"))]
    #[serde(deserialize_with = "one_or_many")]
    pub moving_wall: Vec<MovingWall>,
    /// Inflow through boundary edges in a ball: at, radius and speed.
    #[cfg_attr(feature = "clap", arg(long, value_parser = table::<InflowScene>, value_name = "NAME = VALUE, …"))]
    #[serde(deserialize_with = "one_or_many")]
    pub inflow: Vec<InflowScene>,
    /// Outflow of what flows in, through boundary edges in a ball: at and radius.
    #[cfg_attr(feature = "clap", arg(long, value_parser = table::<Ball>, value_name = "NAME = VALUE, …"))]
    #[serde(deserialize_with = "one_or_many")]
    pub outflow: Vec<Ball>,
}

impl Request for FluidRequest {
    const NAME: &'static str = "fluid";
    // Systems are factored before the first step, which cannot be interrupted.
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = FluidReport;
}
