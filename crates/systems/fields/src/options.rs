//! Options of a decomposition.

use pompeiu_operators::{Boundary, Splitting};

/// Options of a Helmholtz–Hodge decomposition: by default the primal splitting with tangential harmonic fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DecompositionOptions {
    /// Which of the two potentials is conforming, and which nonconforming.
    pub splitting: Splitting,
    /// The condition at the boundary.
    pub boundary: Boundary,
}
