//! Errors of flattening.

use crate::CutError;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::SolveError;
use pompeiu_surface::GeometryError;

/// How many faces are flipped or without area, if any are.
fn flipped(faces: &[FaceId]) -> String {
    let Some(first) = faces.first() else { return String::new() };
    let (count, are) = (faces.len(), if faces.len() == 1 { "face is" } else { "faces are" });
    format!("{count} {are} flipped or without area, face {first} the first, and ", first = first.0)
}

fn cure(faces: &[FaceId]) -> &'static str {
    if faces.is_empty() {
        "cut the surface, or give it better faces with `pompeiu remesh`"
    } else {
        "cut the surface there, or leave the boundary free"
    }
}

/// Why a surface cannot be flattened.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlattenError {
    /// The surface cannot be cut.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A linear system could not be solved.
    #[error("a linear system of the map cannot be solved: {0}")]
    Solve(#[from] SolveError),
    /// Faces are flipped or nearly degenerate with all weights tried.
    #[error(
        "the map is crowded: {}the least singular value is {ratio:e} of the greatest; {}",
        flipped(faces),
        cure(faces)
    )]
    Crowded {
        /// The faces.
        faces: Vec<FaceId>,
        /// The least singular value of all faces over the greatest.
        ratio: f64,
    },
    /// The corners do not form a convex polygon.
    #[error(
        "the {corners} corners make no convex polygon; at least 3 are needed, counter-clockwise, none on a line with its neighbours"
    )]
    Polygon {
        /// Their number.
        corners: usize,
    },
    /// The boundary has fewer vertices than the polygon has corners.
    #[error(
        "the boundary has {boundary} vertices, fewer than the {corners} corners of the polygon; split its edges first, for instance with \
         `pompeiu remesh --relative 0.1`, or choose circle or free"
    )]
    FewVertices {
        /// Vertices of the boundary.
        boundary: usize,
        /// Corners of the polygon.
        corners: usize,
    },
    /// The boundary does not lie in a plane.
    #[error(
        "the boundary through vertex {vertex} lies up to {height:e} off its plane, expected at most {most:e}"
    )]
    NotPlanar {
        /// One of its vertices.
        vertex: VertexId,
        /// Greatest distance from the plane, in the unit of the mesh.
        height: f64,
        /// Greatest distance allowed.
        most: f64,
    },
    /// A boundary that keeps its shape cannot have a virtual boundary.
    #[error("the boundary cannot stay as it is and have a virtual boundary around it; choose another curve")]
    VirtualOwn,
    /// Charts are divided, and an option needs them whole.
    #[error(
        "charts are divided only where the boundary is free, the energy symmetric Dirichlet and the strategy of cuts auto, and cuts may go \
         anywhere; leave out the charts, or {option}"
    )]
    Whole {
        /// The option.
        option: &'static str,
    },
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
}

impl From<GeometryError> for FlattenError {
    fn from(error: GeometryError) -> Self {
        Self::Cut(error.into())
    }
}
