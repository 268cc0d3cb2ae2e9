//! Errors in SWC files.

/// Why an SWC file cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SwcError {
    /// There are no samples.
    #[error("there is no sample in the file")]
    Empty,
    /// A row has too few fields.
    #[error("line {line}: found {found} fields, expected 7: id, type, x, y, z, radius, parent")]
    Fields {
        /// Line of the file, from 1.
        line: usize,
        /// How many there are.
        found: usize,
    },
    /// A field is not a number, or not an integer where one is needed.
    #[error("line {line}: the {field} of the sample is {found:?}, which is not a {}", if matches!(*.field, "id" | "type" | "parent") { "whole number" } else { "number" })]
    Number {
        /// Line of the file, from 1.
        line: usize,
        /// The column.
        field: &'static str,
        /// What is there.
        found: String,
    },
    /// A number is out of range.
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
    /// Two samples have the same number.
    #[error("line {line}: sample {id} was stated in line {first} already")]
    Duplicate {
        /// Line of the second, from 1.
        line: usize,
        /// Their number.
        id: i64,
        /// Line of the first.
        first: usize,
    },
    /// The parent of a sample does not exist.
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
    /// Samples form a cycle.
    #[error("line {line}: sample {id} continues itself over {length} samples; --repair makes it a root")]
    Cycle {
        /// Line of one of them, from 1.
        line: usize,
        /// The sample in that line.
        id: i64,
        /// The length of the cycle.
        length: usize,
    },
    /// A radius is negative.
    #[error(
        "line {line}: the radius of sample {id} is {radius}, expected at least 0; --repair takes it from its neighbours"
    )]
    NegativeRadius {
        /// Line of the file, from 1.
        line: usize,
        /// The sample.
        id: i64,
        /// Its radius.
        radius: f64,
    },
    /// There are too many samples.
    #[error("there are {0} samples, at most 100 million can be used")]
    TooMany(usize),
}
