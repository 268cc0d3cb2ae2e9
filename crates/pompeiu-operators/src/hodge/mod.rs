//! Splitting fields into a gradient, a rotated gradient and a harmonic part.

mod audit;
mod basis;
mod decomposition;
mod one_kind;
mod spaces;

pub use audit::{Audit, OneKind};
pub use basis::HarmonicBasis;
pub use decomposition::{Decomposition, HodgeSolver, InnerProducts, Norms, Quality, SetupTimes};
pub use one_kind::{FunctionKind, OneKindParts, OneKindSolver};
pub use spaces::{Boundary, Splitting};
