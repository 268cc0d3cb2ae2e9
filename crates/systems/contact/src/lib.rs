//! Elastic solids, cloth and shells in contact that never intersect.
//!
//! # Definition
//! Each step in time minimises inertia, elastic energies, barriers `κ b(d²)` of all pairs of surfaces closer than d̂, and friction that is
//! smooth and lagged (incremental potential contact). Newton's method starts from positions without intersections, and each of its steps
//! is cut short by continuous collision detection, so that no two surfaces ever cross.
//!
//! | part | what it does |
//! |---|---|
//! | [`distance`] | squared distances of points, edges and triangles with derivatives, by one formula |
//! | [`ccd`] | a time up to which moving pairs do not touch (additive continuous collision detection) |
//! | [`Bodies`] | neo-Hookean tetrahedra, membranes after Saint-Venant and Kirchhoff, bending at edges, obstacles, handles |
//! | [`Simulation`] | implicit Euler or BDF2 by projected Newton; barriers become stiffer where surfaces come too close |
//!
//! # The certificate
//! [`Check::Every`] runs an exact test, which shares no arithmetic with the simulation, on the positions of every accepted step. A start
//! that intersects is refused with the pairs named.
//!
//! # Limits
//! Implicit Euler damps angular momentum and energy. Friction is lagged by one step.
//!
//! # Example
//! ```
//! use glam::DVec3;
//! use pompeiu_contact::{Bodies, ContactOptions, Material, Obstacle, Simulation, shapes::tetrahedral_box};
//!
//! let mut bodies = Bodies::new();
//! let (positions, tetrahedra) = tetrahedral_box(DVec3::new(0.0, 0.0, 0.0005), DVec3::new(1.0, 1.0, 1.0005), [1, 1, 1]);
//! let material = Material { young: 1e6, poisson: 0.3, density: 1000.0 };
//! bodies.add_solid(&positions, &tetrahedra, material)?;
//! bodies.add_obstacle(Obstacle::HalfSpace { normal: DVec3::Z, offset: 0.0 })?;
//! let mut simulation = Simulation::new(bodies, ContactOptions::new(0.01, 1.0))?;
//! for _ in 0..5 {
//!     let step = simulation.step()?;
//!     assert_eq!(step.intersections, Some(0));
//! }
//! assert!(simulation.positions().iter().all(|p| p.z > 0.0));
//! # Ok::<(), pompeiu_contact::ContactError>(())
//! ```
//!
//! # Source
//! `li_incremental_2020`, `li_codimensional_2021`, `grinspun_discrete_2003`, `smith_analytic_2019`.

pub mod barrier;
mod bodies;
mod boxes;
pub mod ccd;
mod contact;
mod curvature;
mod dense;
pub mod distance;
mod elastic;
mod error;
mod objective;
mod options;
mod potential;
mod precise;
mod report;
#[cfg(feature = "serde")]
pub mod request;
pub mod shapes;
#[cfg(feature = "figures")]
pub mod show;
mod simulation;
mod surface;
mod tetrahedron;

pub use bodies::{Bodies, Handle, HandleMotion, Material, Obstacle};
pub use contact::Contact;
pub use curvature::Curvature;
pub use distance::Kind;
pub use error::ContactError;
pub use options::{Check, ContactOptions, Integrator, PairSet, Projection};
pub use report::{ContactStep, ContactTiming};
#[cfg(feature = "serde")]
pub use request::{ContactReport, ContactRequest, ContactRequestError, Scene};
pub use simulation::{ContactState, Simulation};
