//! Errors of building, factoring and solving systems.

/// Why a matrix cannot be built or factored, or a system cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// An entry lies outside the matrix.
    #[error("entry ({row}, {column}) lies outside a matrix of {rows} rows and {columns} columns")]
    OutOfRange {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        column: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// An entry is NaN or infinite.
    #[error("entry ({row}, {column}) of the matrix is {value}, expected a finite number")]
    NonFinite {
        /// Row of the entry, from 0.
        row: usize,
        /// Column of the entry, from 0.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// The matrix is not square.
    #[error("the matrix has {rows} rows and {columns} columns, expected as many rows as columns")]
    NotSquare {
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// The matrix has another pattern than the analysed one.
    #[error("the matrix has other non-zero places than the one that was analysed; analyse it anew")]
    OtherPattern,
    /// An input has the wrong length.
    #[error("found {found} {what}, expected {expected}")]
    Length {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A value of a right-hand side is NaN or infinite.
    #[error("value {index} of the right-hand side is {value}, expected a finite number")]
    NonFiniteRightHandSide {
        /// Its place, from 0.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A pivot of a Cholesky factorization is zero, negative or NaN.
    #[error(
        "the pivot of unknown {index} is not above zero, so the matrix is not positive definite: \
         fix an unknown for each constant in the kernel, or use the factorization for indefinite matrices"
    )]
    NotPositiveDefinite {
        /// The unknown, from 0, in the order of the matrix.
        index: usize,
    },
    /// A pivot of an `LDLᵀ` factorization is zero or not finite.
    #[error("the pivot of unknown {index} is zero: the matrix is singular or needs pivoting, use LU")]
    ZeroPivot {
        /// The unknown, from 0, in the order of the matrix.
        index: usize,
    },
    /// The matrix is singular, to working precision.
    #[error("the matrix is singular: unknown {index} cannot be determined")]
    Singular {
        /// An unknown that is undetermined, from 0.
        index: usize,
    },
    /// The factor does not fit in memory or in the range of indices.
    #[error("there is no memory to factor a matrix with {unknowns} unknowns and {nonzeros} entries")]
    NoMemory {
        /// Unknowns of the system.
        unknowns: usize,
        /// Entries of the matrix.
        nonzeros: usize,
    },
}
