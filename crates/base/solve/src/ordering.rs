//! Elimination orders.

/// The order in which a symmetric factorization eliminates its unknowns; it determines the fill-in of the factor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ordering {
    /// Approximate minimum degree.
    #[default]
    MinimumDegree,
    /// The order of the matrix.
    Natural,
    /// The unknown with index `order[0]` first, and so on; every index once.
    Given(Vec<usize>),
}
