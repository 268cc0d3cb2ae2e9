//! Triangle meshes, valid by construction.

mod coordinates;
mod data;
mod edges;
pub mod edit;
mod error;
mod ids;
mod positions;
pub mod repair;
pub mod shapes;
pub mod topology;
mod trimesh;
mod unit_factor;

pub use coordinates::{Asked, Coordinates, Grid, Precision, Rounding, TooCoarse};
pub use data::{DataLengthError, ElementData, ElementId, FaceData, VertexData};
pub(crate) use edges::has_three_vertices;
pub use edit::{
    Affine, Random, displace_at_random, merge, ripple, shuffle, subdivide, transform, unweld,
    without_unreferenced,
};
pub use error::MeshError;
pub use ids::{FaceId, VertexId};
pub use positions::first_at_position;
pub use topology::{Connectivity, MeshSummary, UnionFind, area, unreferenced_vertices};
pub use trimesh::TriMesh;
pub use unit_factor::unit_factor;
