//! Incompressible flow on triangle surfaces of any genus, with transport of densities.
//!
//! # Definition
//! The Navier–Stokes equations on a surface, `u' + ∇_u u = −∇p + ν Δ u + f` with `div u = 0`, and for each density `ρ' + u·∇ρ = κ Δ
//! ρ + s`. A velocity is `u = J G_v ψ + Σ c_k h_k`: a stream function ψ at vertices and coefficients of harmonic fields, which is
//! free of divergence without a projection. The unknowns are the vorticity ω at vertices and the `c_k`. On a surface with handles
//! the coefficients have equations of their own, `c_k' = −∫ ω (J u)·h_k`, without which energy is not conserved.
//!
//! | part | what it does |
//! |---|---|
//! | advection | Galerkin form of the vorticity equation with consistent mass: energy, enstrophy and total vorticity are conserved in space; Runge–Kutta in substeps, or the implicit midpoint rule, which conserves them in time |
//! | [`Scheme::AnyStep`] | semi-Lagrangian advection of the vorticity with `MacCormack`'s correction, stable at any step |
//! | [`Scheme::Faces`] | semi-Lagrangian advection of velocities on faces with parallel transport, stable at any step |
//! | [`Scheme::CrouzeixRaviart`] | viscosity on velocities at midpoints of edges, projected exactly |
//! | viscosity | backward Euler for the Hodge, Bochner or physical Laplacian ([`ViscosityModel`]) |
//! | densities | flux-corrected transport between dual cells, or semi-Lagrangian ([`Transport`]); sources, diffusion |
//! | [`square`] | the unit square on a grid: Stam's method, or a MAC grid with obstacles |
//! | forces | weight of densities, rotation of the surface, vorticity confinement, fields |
//!
//! # Measured quantities
//! Each step reports its energy, enstrophy, total vorticity, divergence, masses and harmonic coefficients: [`FluidStep`].
//!
//! # Example
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_fluid::{FluidOptions, Simulation};
//! use pompeiu_operators::rotation_field;
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let sphere = EmbeddedSurface::new(&icosphere(1.0, 3)?)?;
//! let mut fluid = Simulation::new(sphere.surface(), FluidOptions { viscosity: 0.1, ..FluidOptions::new(0.05) })?;
//! fluid.set_velocity(&rotation_field(&sphere, [0.0, 0.0, 1.0]))?;
//! let before = fluid.measure()?.energy;
//! for _ in 0..5 {
//!     fluid.step()?;
//! }
//! // A rigid rotation is not slowed down by physical viscosity.
//! assert!((fluid.measure()?.energy / before - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Source
//! `stam_stable_1999`, `elcott_stable_2007`, `yin_fluid_2023`.

mod advection;
mod curvature;
mod edges;
mod error;
mod faces;
mod force;
mod inflow;
mod options;
mod report;
#[cfg(feature = "serde")]
pub mod request;
#[cfg(feature = "figures")]
pub mod show;
mod simulation;
mod space;
pub mod square;
mod transport;
mod viscosity;

pub use error::FluidError;
pub use force::{coriolis, tangential};
pub use options::{
    Correction, Density, Diffusion, FluidOptions, Integrator, Scheme, TimeStep, Transport, ViscosityModel,
    Wall,
};
pub use report::{FluidStep, FluidTiming, SchemeReport};
pub use simulation::{Simulation, State};
