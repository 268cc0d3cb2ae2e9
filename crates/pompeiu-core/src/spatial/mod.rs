//! Orders and trees over the faces of a mesh.

pub mod bvh;
mod morton;

pub use bvh::{Bvh, Nearest, Slot};
pub use morton::morton_order;
