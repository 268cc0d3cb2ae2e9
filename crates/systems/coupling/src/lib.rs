//! Partitioned coupling of two black-box solvers at the interface between them.
//!
//! # Definition
//! In each time window a fluid solver computes `y = F(x)`, pressures from displacements, and a solid solver `x̃ = S(y)`, displacements
//! from pressures. The window has converged when `x̃ = x`. Both are black boxes ([`Subproblem`]); the [`Scheme`] uses only inputs and outputs.
//! One *solve* is one F and one S.
//!
//! | scheme | the next input |
//! |---|---|
//! | [`Scheme::Fixed`], [`Scheme::Constant`], [`Scheme::Aitken`] | relaxed: `x + ω (x̃ − x)` |
//! | [`Scheme::IqnIls`] | the change that cancels `x̃ − x` in the least-squares model of previous solves, also of earlier windows |
//! | [`Scheme::IqnImvj`] | the same, with the Jacobian nearest to the last window's |
//! | [`Scheme::TwoModels`] | from a least-squares model of each solver |
//!
//! A failed window is repeated with a damped part of the residual that the model does not explain. If all attempts fail, the error contains
//! the [`AddedMass`] number, which explains why fixed-point iteration diverges.
//!
//! # Enclosed regions
//! If all walls of an incompressible fluid have prescribed velocities, its pressure is determined up to a constant, and iteration converges
//! to a wrong volume without notice. This is detected ([`Subproblem::imbalance`]), and either corrected by choosing the constant so that
//! the displacement of the solid equals the inflow, or rejected ([`Closed`]).
//!
//! # Limits
//! No scheme converges for every pair of solvers.
//!
//! # Example
//! ```
//! use pompeiu_coupling::{Coupling, CouplingOptions, piston::{Piston, PistonOptions}};
//!
//! // A fluid column ten times as heavy as its piston: fixed-point iteration diverges.
//! let piston = Piston::new(PistonOptions { fluid_mass: 10.0, ..PistonOptions::default() })?;
//! let mut coupling = Coupling::new(piston.fluid(), piston.solid(), &[piston.start()], CouplingOptions::default())?;
//! let first = coupling.advance()?;
//! assert!(first.solves <= 4 && first.added_mass.is_some_and(|a| a.number > 9.0));
//! # Ok::<(), pompeiu_coupling::CouplingError>(())
//! ```
//!
//! # Source
//! `degroote_performance_2009` for IQN-ILS, `bogaers_quasi_2014` for IMVJ, `vierendeels_implicit_2007` for a model of each solver,
//! `kuttler_fixed_2008` for Aitken's relaxation, `akbay_extended_2018` for enclosed regions.

mod added_mass;
pub mod channel;
mod columns;
mod coupling;
mod error;
mod iteration;
mod options;
pub mod piston;
mod report;
#[cfg(feature = "serde")]
mod request;
pub mod scenario;
#[cfg(feature = "figures")]
pub mod show;
mod subproblem;
pub mod tube;
pub mod wall;

pub use added_mass::AddedMass;
pub use coupling::Coupling;
pub use error::CouplingError;
pub use options::{Closed, CouplingOptions, Scheme};
pub use report::WindowReport;
#[cfg(feature = "serde")]
pub use request::{CoupleReport, CoupleRequest, Kind, Scene, SceneError};
pub use subproblem::{Function, Imbalance, Refusal, Subproblem};
