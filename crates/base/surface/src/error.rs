//! Errors of meshes that are no oriented manifold or have no usable geometry.

use pompeiu_core::{FaceId, VertexId};

/// Why faces do not make an oriented manifold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// There are no faces.
    #[error("there are no faces, expected at least one")]
    NoFaces,
    /// More half-edges than 32-bit indices can name.
    #[error("there are {faces} faces; at most {} are supported", u32::MAX / 3)]
    TooManyFaces {
        /// Their number.
        faces: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {vertices} vertices (the first is 0)")]
    NoSuchVertex {
        /// The face.
        face: FaceId,
        /// The index it holds.
        vertex: VertexId,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face names a vertex more than once.
    #[error("face {face} names vertex {vertex} more than once; `pompeiu repair` removes such faces")]
    RepeatedVertex {
        /// The face.
        face: FaceId,
        /// The vertex.
        vertex: VertexId,
    },
    /// A vertex is in no face.
    #[error("vertex {vertex} is in no face; remove it")]
    UnreferencedVertex {
        /// The vertex.
        vertex: VertexId,
    },
    /// An edge has more than two faces.
    #[error(
        "the edge from vertex {} to vertex {} is in {faces} faces, {} and {} among them, expected one or two; `pompeiu repair` splits such edges",
        ends[0], ends[1], first[0], first[1]
    )]
    NonManifoldEdge {
        /// Its ends.
        ends: [VertexId; 2],
        /// Number of its faces.
        faces: usize,
        /// Two of them.
        first: [FaceId; 2],
    },
    /// Two neighbours run along their common edge in the same direction, although a consistent orientation exists.
    #[error(
        "faces {} and {} both run from vertex {} to vertex {}: one of them is turned over; `pompeiu repair` turns it",
        faces[0], faces[1], ends[0], ends[1]
    )]
    Misoriented {
        /// The two faces.
        faces: [FaceId; 2],
        /// The edge, as both run along it.
        ends: [VertexId; 2],
    },
    /// The surface is not orientable.
    #[error(
        "the surface has one side only: following its faces from one to the next, faces {} and {} disagree at the edge \
         from vertex {} to vertex {}; `pompeiu repair` cuts it open",
        faces[0], faces[1], ends[0], ends[1]
    )]
    NonOrientable {
        /// Two neighbours that cannot be made to agree.
        faces: [FaceId; 2],
        /// Their common edge.
        ends: [VertexId; 2],
    },
    /// The faces around a vertex form more than one fan.
    #[error(
        "the {faces} faces around vertex {vertex} form more than one fan; `pompeiu repair` splits such vertices"
    )]
    NonManifoldVertex {
        /// The vertex.
        vertex: VertexId,
        /// Number of faces around it.
        faces: usize,
    },
}

/// Why a mesh has no usable geometry.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// The mesh is not a surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A face is so thin that its corners do not determine its height, or its edge lengths violate the triangle inequality.
    #[error(
        "face {face} is degenerate: {}; `pompeiu repair` drops faces without area, `pompeiu remesh` makes better ones of thin ones",
        shape(*.lengths, *.height, *.least)
    )]
    DegenerateFace {
        /// The face.
        face: FaceId,
        /// Lengths of its edges, from corner 0 to 1, 1 to 2, 2 to 0.
        lengths: [f64; 3],
        /// Its least height over its longest edge, 0 if there is none.
        height: f64,
        /// The least supported.
        least: f64,
    },
    /// Areas or their inverses would overflow or underflow.
    #[error(
        "the edges of face {face} are about {length:e} long; expected lengths between {least:e} and {most:e}"
    )]
    Scale {
        /// The face.
        face: FaceId,
        /// Its longest edge.
        length: f64,
        /// The least supported.
        least: f64,
        /// The greatest supported.
        most: f64,
    },
    /// There are too many or too few lengths.
    #[error("found {found} edge lengths, expected {expected}, one for each edge")]
    LengthCount {
        /// How many there are.
        found: usize,
        /// How many edges there are.
        expected: usize,
    },
}

/// What is wrong with the shape of a face.
fn shape(lengths: [f64; 3], height: f64, least: f64) -> String {
    let [a, b, c] = lengths;
    match lengths.iter().filter(|length| **length == 0.0).count() {
        0 => format!(
            "its edges are {a:e}, {b:e} and {c:e} long and its height is {height:e} of the longest, expected at least {least:e}"
        ),
        3 => "its corners are all at one position".to_owned(),
        _ => "two of its corners are at one position".to_owned(),
    }
}
