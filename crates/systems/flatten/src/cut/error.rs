//! Errors of cutting.

use crate::SymmetryError;
use pompeiu_core::{FaceId, MeshError, VertexId};
use pompeiu_medial::MedialError;
use pompeiu_surface::{GeometryError, SurfaceError};

/// Why a surface cannot be cut.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutError {
    /// The mesh has no usable geometry.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The opened surface has more vertices than indices can name.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Two options that exclude each other.
    #[error("{first} and {second} are both given; choose one")]
    Both {
        /// One.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A component of the opened surface is not a disk.
    #[error(
        "the part that holds face {face} is no disk after the cut: it has {boundary_loops} boundary loops and Euler \
         characteristic {euler_characteristic}, expected 1 and 1; the strategies auto and tips leave a disk of each part"
    )]
    NoDisk {
        /// One of its faces.
        face: FaceId,
        /// Its vertices minus edges plus faces.
        euler_characteristic: isize,
        /// Its boundary loops.
        boundary_loops: usize,
    },
    /// The cut is a single edge, which opens nothing.
    #[error(
        "cutting the edge from vertex {} to vertex {} alone opens nothing, because both ends stay whole; cut another edge at \
         one of them, too",
        ends[0], ends[1]
    )]
    SingleEdge {
        /// Its ends.
        ends: [VertexId; 2],
    },
    /// No edge joins two consecutive vertices of a path.
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
    /// The weight of curvature is negative or no number.
    #[error("the weight of curvature is {weight}; it must be a number, 0 or more")]
    Curvature {
        /// The weight.
        weight: f64,
    },
    /// The spread for stopping is not a positive number.
    #[error("the spread of distances is {spread}; it must be a number above 0")]
    Spread {
        /// The spread.
        spread: f64,
    },
    /// Medial balls, which the strategy needs, cannot be computed.
    #[error(transparent)]
    Medial(#[from] MedialError),
    /// Rounding made a straightened path invalid.
    #[error(
        "the straightened path from vertex {vertex} cannot be followed across faces, which are too thin there"
    )]
    Straight {
        /// The start of the path.
        vertex: VertexId,
    },
    /// The cut cannot be symmetric.
    #[error(transparent)]
    Symmetry(#[from] SymmetryError),
    /// Every cut would enter a forbidden place.
    #[error(
        "no admissible cut opens the part that holds face {face}: every one enters a forbidden edge or vertex"
    )]
    Forbidden {
        /// A face of the part.
        face: FaceId,
    },
    /// The caller requested a forbidden edge.
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
