//! Splitting fields into a gradient, a rotated gradient and a harmonic part.

mod audit;
mod basis;
mod decomposition;
mod spaces;

pub use audit::{Audit, OneKind};
pub use basis::HarmonicBasis;
pub use decomposition::{Decomposition, HodgeSolver, InnerProducts, Norms, Quality, SetupTimes};
pub use spaces::{Boundary, Splitting};
