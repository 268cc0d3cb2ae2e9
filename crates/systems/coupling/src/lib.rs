//! Two solvers that each know half of a problem, made to agree at the interface between them.
//!
//! # Definition
//! In each window in time a fluid gives `y = F(x)`, pressures for displacements, and a solid `x̃ = S(y)`, displacements for pressures.
//! The window is done when `x̃ = x`. Both are black boxes ([`Subproblem`]); the [`Scheme`] sees only what goes in and comes out.
//! One *solve* is one F and one S.
//!
//! | scheme | the next input |
//! |---|---|
//! | [`Scheme::Fixed`], [`Scheme::Constant`], [`Scheme::Aitken`] | relaxed: `x + ω (x̃ − x)` |
//! | [`Scheme::IqnIls`] | the change that least squares over earlier solves, of earlier windows too, say removes `x̃ − x` |
//! | [`Scheme::IqnImvj`] | the same, with the Jacobian nearest to the last window's |
//! | [`Scheme::TwoModels`] | from a least-squares model of each solver |
//!
//! When a window fails it is tried again with only a part of what the model does not explain. When it fails for good, the error says
//! why plain iteration cannot work: the [`AddedMass`] number.
//!
//! # Enclosed regions
//! Where all walls of an incompressible fluid have given velocities, its pressure is known up to a constant, and iteration converges to
//! a wrong volume without a sign. This is detected ([`Subproblem::imbalance`]), and cured by choosing the constant so that the solid
//! takes in what flows in, or refused ([`Closed`]).
//!
//! # Limits
//! No scheme makes every pair of solvers agree.
//!
//! # Example
//! ```
//! use pompeiu_coupling::{Coupling, CouplingOptions, piston::{Piston, PistonOptions}};
//!
//! // A fluid column ten times as heavy as its piston: plain iteration diverges.
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
mod subproblem;
pub mod tube;
pub mod wall;

pub use added_mass::AddedMass;
pub use coupling::Coupling;
pub use error::CouplingError;
pub use options::{Closed, CouplingOptions, Scheme};
pub use report::WindowReport;
pub use subproblem::{Function, Imbalance, Refusal, Subproblem};
