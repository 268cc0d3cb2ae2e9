//! Options of a decomposition.

use pompeiu_operators::{Boundary, Splitting};

/// Which Helmholtz–Hodge decomposition: the defaults are the primal splitting with tangential harmonic fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DecompositionOptions {
    /// Which of the two potentials is conforming, and which nonconforming.
    pub splitting: Splitting,
    /// The condition at the boundary.
    pub boundary: Boundary,
}
