//! Why shapes cannot be analysed as asked.

use pompeiu_planar::OutlineError;

/// Why shapes cannot be analysed as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComplexityError {
    /// No shape.
    #[error("there are no shapes")]
    Empty,
    /// A number of clusters that the shapes do not allow.
    #[error(
        "{clusters} clusters are asked for of {shapes} shapes; there must be at least 1 and at most as many as shapes"
    )]
    Clusters {
        /// Clusters asked for.
        clusters: usize,
        /// Shapes there are.
        shapes: usize,
    },
    /// A name of no measure.
    #[error("there is no measure `{found}`; there are {known}")]
    Measure {
        /// The name.
        found: String,
        /// All names.
        known: String,
    },
    /// Two rankings of different lengths, or too short ones.
    #[error("the rankings have {a} and {b} places; both must have the same number, at least 2")]
    Lengths {
        /// Places of the first one.
        a: usize,
        /// Places of the second one.
        b: usize,
    },
    /// A shape that is missing in a ranking.
    #[error("`{0}` is not in the ranking")]
    Unranked(String),
    /// An option out of range.
    #[error("the {what} is {value}; {expected}")]
    Option {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// Points that make no outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}
