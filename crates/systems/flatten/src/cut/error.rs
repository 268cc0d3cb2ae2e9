//! Why a surface cannot be cut.

use crate::{MedialError, SymmetryError};
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::{GeometryError, SurfaceError};

/// Why a surface cannot be cut as asked.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutError {
    /// The mesh is no surface to measure on.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// A component of the opened surface is not a disk.
    #[error(
        "the part that holds face {face} is no disk after the cut: it has {boundary_loops} boundary loops and Euler \
         characteristic {euler_characteristic}, expected 1 and 1"
    )]
    NoDisk {
        /// One of its faces.
        face: FaceId,
        /// Its vertices minus edges plus faces.
        euler_characteristic: isize,
        /// Its boundary loops.
        boundary_loops: usize,
    },
    /// A cut of a single edge, which opens nothing.
    #[error(
        "cutting the edge from vertex {} to vertex {} alone opens nothing, because both ends stay whole; cut another edge at \
         one of them, too",
        ends[0], ends[1]
    )]
    SingleEdge {
        /// Its ends.
        ends: [VertexId; 2],
    },
    /// No edge joins two vertices that are named one after the other.
    #[error("no edge joins vertices {} and {}", ends[0], ends[1])]
    NoEdge {
        /// The vertices.
        ends: [VertexId; 2],
    },
    /// A vertex does not exist.
    #[error("there is no vertex {vertex}; there are {vertices} (the first is 0)")]
    NoVertex {
        /// The index.
        vertex: VertexId,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face does not exist.
    #[error("there is no face {face}; there are {faces} (the first is 0)")]
    NoFace {
        /// The index.
        face: FaceId,
        /// Number of faces.
        faces: usize,
    },
    /// The weight of curvature is no number from 0 on.
    #[error("the weight of curvature is {weight}; it must be a number, 0 or more")]
    Curvature {
        /// The weight.
        weight: f64,
    },
    /// The spread at which no more is cut is no number above 0.
    #[error("the spread of distances is {spread}; it must be a number above 0")]
    Spread {
        /// The spread.
        spread: f64,
    },
    /// The surface cannot be filled with balls, which the strategy follows.
    #[error(transparent)]
    Medial(#[from] MedialError),
    /// A straightened path was lost by rounding.
    #[error(
        "the straightened path from vertex {vertex} cannot be followed across faces, which are too thin there"
    )]
    Straight {
        /// Where it begins.
        vertex: VertexId,
    },
    /// The plane of symmetry cannot be kept.
    #[error(transparent)]
    Symmetry(#[from] SymmetryError),
    /// Every cut would enter what is forbidden.
    #[error(
        "no admissible cut opens the part that holds face {face}: every one enters a forbidden edge or vertex"
    )]
    Forbidden {
        /// A face of the part.
        face: FaceId,
    },
    /// Edges that the caller named are forbidden.
    #[error("the edge from vertex {} to vertex {} is to be cut, but is forbidden", ends[0], ends[1])]
    ForbiddenEdge {
        /// Its ends.
        ends: [VertexId; 2],
    },
}

impl From<SurfaceError> for CutError {
    fn from(error: SurfaceError) -> Self {
        Self::Geometry(error.into())
    }
}
