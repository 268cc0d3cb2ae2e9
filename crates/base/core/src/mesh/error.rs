//! What can be wrong with positions and faces handed in as a mesh.

use super::{FaceId, VertexId};

/// See [`TriMesh::MAX_COORDINATE`](super::TriMesh::MAX_COORDINATE).
pub(super) const MAX_COORDINATE: f64 = f64::from_bits((1023 + 1000) << 52);

/// Why positions and faces do not make a [`TriMesh`](super::TriMesh).
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The mesh has no faces.
    #[error("the mesh has no faces ({vertices} vertices)")]
    NoFaces {
        /// Number of vertices.
        vertices: usize,
    },
    /// More elements than 32-bit indices can name.
    #[error("the mesh has {count} {what}; at most {} are supported", u32::MAX)]
    TooMany {
        /// `"vertices"` or `"faces"`.
        what: &'static str,
        /// Their number.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("coordinate {} of vertex {} is {value}", ["x", "y", "z"][*axis], vertex.0)]
    NonFinite {
        /// The vertex.
        vertex: VertexId,
        /// 0, 1 or 2.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// A coordinate is so large that distances could overflow.
    #[error("coordinate {} of vertex {} is {value:e}; at most {:e} in magnitude is supported", ["x", "y", "z"][*axis], vertex.0, MAX_COORDINATE)]
    TooLarge {
        /// The vertex.
        vertex: VertexId,
        /// 0, 1 or 2.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// A face names a vertex that does not exist.
    #[error("face {} names vertex {index}, but there are {vertices} vertices (the first is 0)", face.0)]
    IndexOutOfRange {
        /// The face.
        face: FaceId,
        /// The index it holds.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
}
