//! Triangle meshes: checked once, trusted afterwards.

mod error;
mod ids;
mod trimesh;

pub use error::MeshError;
pub use ids::{FaceId, VertexId};
pub use trimesh::TriMesh;
