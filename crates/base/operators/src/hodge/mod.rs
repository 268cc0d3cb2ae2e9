//! Spaces of potentials and of harmonic fields: what Helmholtz–Hodge decompositions are built of.

mod basis;
mod spaces;

pub use basis::HarmonicBasis;
pub use spaces::{Boundary, DirichletPotential, Splitting, conforming_system, crouzeix_raviart_system};
