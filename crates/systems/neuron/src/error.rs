//! Why a skeleton cannot be used.

/// Why a file holds no skeleton.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SwcError {
    /// No row states a sample.
    #[error("there is no sample in the file")]
    Empty,
    /// Too few fields.
    #[error("line {line}: found {found} fields, expected 7: id, type, x, y, z, radius, parent")]
    Fields {
        /// Line of the file, from 1.
        line: usize,
        /// How many there are.
        found: usize,
    },
    /// Text that is no number, or no whole number where one is needed.
    #[error("line {line}: the {field} of the sample is {found:?}, which is not a {}", if matches!(*.field, "id" | "type" | "parent") { "whole number" } else { "number" })]
    Number {
        /// Line of the file, from 1.
        line: usize,
        /// The column.
        field: &'static str,
        /// What is there.
        found: String,
    },
    /// A number that is no length.
    #[error(
        "line {line}: the {field} of the sample is {value}, expected a number of at most 1e12 micrometres"
    )]
    NotFinite {
        /// Line of the file, from 1.
        line: usize,
        /// The column.
        field: &'static str,
        /// What is there.
        value: f64,
    },
    /// Two samples of one number.
    #[error("line {line}: sample {id} was stated in line {first} already")]
    Duplicate {
        /// Line of the second, from 1.
        line: usize,
        /// Their number.
        id: i64,
        /// Line of the first.
        first: usize,
    },
    /// A sample continues one that does not exist.
    #[error(
        "line {line}: sample {id} continues sample {parent}, which does not exist; --repair makes it a root"
    )]
    MissingParent {
        /// Line of the file, from 1.
        line: usize,
        /// The sample.
        id: i64,
        /// The one that is missing.
        parent: i64,
    },
    /// Samples that continue each other.
    #[error("line {line}: sample {id} continues itself over {length} samples; --repair makes it a root")]
    Cycle {
        /// Line of one of them, from 1.
        line: usize,
        /// That one.
        id: i64,
        /// How many samples the cycle has.
        length: usize,
    },
    /// A radius below zero.
    #[error(
        "line {line}: the radius of sample {id} is {radius}, expected at least 0; --repair takes it from its neighbours"
    )]
    NegativeRadius {
        /// Line of the file, from 1.
        line: usize,
        /// The sample.
        id: i64,
        /// What is there.
        radius: f64,
    },
    /// More samples than indices.
    #[error("there are {0} samples, at most 100 million can be used")]
    TooMany(usize),
}
