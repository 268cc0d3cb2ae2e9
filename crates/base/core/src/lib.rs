//! The vocabulary of pompeiu: meshes, geometry by pairs, outward arithmetic, spatial trees, and how computations run.
//!
//! This crate opens no files and solves no linear systems.

pub mod exact;
pub mod geom;
pub mod mesh;
pub mod run;
pub mod spatial;

pub use mesh::{FaceId, MeshError, MeshSummary, TriMesh, VertexId};
