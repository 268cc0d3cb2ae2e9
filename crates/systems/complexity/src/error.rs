//! Errors of analyses.

use pompeiu_planar::OutlineError;

/// Why shapes cannot be analysed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComplexityError {
    /// There are no shapes.
    #[error("there are no shapes")]
    Empty,
    /// The number of clusters is not possible for the number of shapes.
    #[error(
        "{clusters} clusters are asked for of {shapes} shapes; there must be at least 1 and at most as many as shapes"
    )]
    Clusters {
        /// Requested clusters.
        clusters: usize,
        /// Number of shapes.
        shapes: usize,
    },
    /// The measure does not exist.
    #[error("there is no measure `{found}`; there are {known}")]
    Measure {
        /// The name.
        found: String,
        /// All measures.
        known: String,
    },
    /// The rankings differ in length or are too short.
    #[error("the rankings have {a} and {b} places; both must have the same number, at least 2")]
    Lengths {
        /// Length of the first one.
        a: usize,
        /// Length of the second one.
        b: usize,
    },
    /// A ranking lacks a shape.
    #[error("`{0}` is not in the ranking")]
    Unranked(String),
    /// An option is out of range.
    #[error("the {what} is {value}; {expected}")]
    Option {
        /// The option.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        expected: &'static str,
    },
    /// Points do not form an outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}
