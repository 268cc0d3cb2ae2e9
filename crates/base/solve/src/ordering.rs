//! In which order unknowns are eliminated.

/// The order in which a symmetric factorization eliminates its unknowns: it decides how much the factor fills up.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ordering {
    /// Approximate minimum degree.
    #[default]
    MinimumDegree,
    /// As they come.
    Natural,
    /// The unknown with index `order[0]` first, and so on; every index once.
    Given(Vec<usize>),
}
