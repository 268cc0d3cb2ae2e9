//! The vocabulary of pompeiu: meshes, geometry by pairs, outward arithmetic and spatial trees.
//!
//! This crate opens no files and solves no linear systems.

pub mod exact;
pub mod geom;
pub mod mesh;
pub mod spatial;

pub use mesh::{FaceId, MeshError, MeshSummary, TriMesh, VertexId};
