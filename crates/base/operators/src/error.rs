//! Errors of operators.

use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::SolveError;
use pompeiu_surface::{GeometryError, Surface};

/// A face is reported as thin when its least height is less than this share of its longest edge. In Laplacians that are not
/// positive definite in double precision, the responsible faces are considerably thinner.
const THIN: f64 = 1e-4;

/// Why an operator cannot be applied or a system cannot be solved.
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
    /// A component, a potential or a norm of a field exceeds the range of doubles.
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
    /// The time of the heat method is not a finite number above zero.
    #[error("the time of the heat method is {time}, expected a finite number above zero")]
    HeatTime {
        /// The time.
        time: f64,
    },
    /// The heat of the sources underflows before it reaches all vertices.
    #[error(
        "the heat of the sources falls below the range of doubles before it reaches {count} vertices, vertex {vertex} among \
         them; choose a longer time"
    )]
    HeatUnderflow {
        /// One of the vertices.
        vertex: VertexId,
        /// How many there are.
        count: usize,
    },
    /// A Laplacian is not positive definite in double precision, because faces are too thin.
    #[error(
        "the Laplacian cannot be factored in double precision: {count} faces have a height of less than {THIN:e} of their \
         longest edge; that of face {face} is the least, {height:e}; improve the shape of these faces"
    )]
    ThinFaces {
        /// The thinnest face.
        face: FaceId,
        /// Its least height over its longest edge.
        height: f64,
        /// How many faces are thin.
        count: usize,
    },
    /// The intrinsic Delaunay triangulation has a degenerate face.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// A linear system could not be set up or solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// If a pivot of a Laplacian failed, reports the thin faces instead.
pub(crate) fn name_thin_faces(surface: &Surface, error: SolveError) -> OperatorError {
    let heights = surface.mesh().face_ids().map(|face| (face, surface.relative_height(face)));
    let thin = heights.filter(|&(_, height)| height < THIN);
    let (count, least) = thin.fold((0, None), |(count, least): (usize, Option<(FaceId, f64)>), one| {
        (count + 1, Some(least.filter(|least| least.1 <= one.1).unwrap_or(one)))
    });
    match (error, least) {
        (SolveError::NotPositiveDefinite { .. }, Some((face, height))) => {
            OperatorError::ThinFaces { face, height, count }
        }
        (error, _) => error.into(),
    }
}
