//! What can be wrong with values on a surface.

use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::SolveError;

/// Why an operator cannot be applied or a system not be solved.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OperatorError {
    /// There are too many or too few vectors.
    #[error("the field has {found} vectors, expected {expected}, one for each face")]
    FieldLength {
        /// How many there are.
        found: usize,
        /// How many faces there are.
        expected: usize,
    },
    /// A vector of a field is NaN or infinite.
    #[error("the field is ({}, {}) on face {face}, expected finite numbers", value[0], value[1])]
    NonFiniteField {
        /// The face.
        face: FaceId,
        /// The vector, in the frame of the face.
        value: [f64; 2],
    },
    /// A part, a potential or a norm of a field leaves the range of doubles.
    #[error(
        "a part, a potential or a norm of the field exceeds the range of doubles, the largest component of the field is \
         {largest:e}; scale the field down"
    )]
    FieldTooLarge {
        /// The largest component of the field.
        largest: f64,
    },
    /// There are too many or too few values.
    #[error("found {found} values, expected {expected}, one for each {element}")]
    ValueLength {
        /// `"vertex"` or `"edge"`.
        element: &'static str,
        /// How many there are.
        found: usize,
        /// How many elements there are.
        expected: usize,
    },
    /// A vertex does not exist.
    #[error("vertex {vertex} does not exist, there are {vertices} (the first is 0)")]
    NoSuchVertex {
        /// The vertex.
        vertex: VertexId,
        /// How many there are.
        vertices: usize,
    },
    /// A linear system could not be set up or solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
