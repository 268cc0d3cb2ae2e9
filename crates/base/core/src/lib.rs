//! Foundation of pompeiu: meshes, distances between simple shapes, interval arithmetic, spatial trees, requests and answers of systems,
//! control of running computations, and VTK's XML around arrays.
//!
//! This crate opens no files and solves no linear systems.

pub mod exact;
pub mod geom;
pub mod mesh;
pub mod request;
pub mod run;
pub mod spatial;
pub mod vtk;

pub use mesh::{FaceId, MeshError, MeshSummary, TriMesh, VertexId};
