//! Orders and trees over the faces of a mesh.

pub mod bvh;
mod morton;

pub use bvh::{Bvh, Cover, Nearest, Slot, Workspace};
pub use morton::morton_order;
