//! Spaces of potentials and harmonic fields of the Helmholtz–Hodge decomposition.

mod basis;
mod spaces;

pub use basis::HarmonicBasis;
pub use spaces::{Boundary, DirichletPotential, Splitting, conforming_system, crouzeix_raviart_system};
