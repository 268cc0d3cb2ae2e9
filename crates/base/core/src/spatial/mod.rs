//! Space-filling orders and trees over the faces of a mesh.

pub mod bvh;
mod intersections;
mod morton;
mod neighbours;
mod winding;

pub use bvh::{Bvh, Cover, Leaf, Leaves, Nearest, Slot, Workspace};
pub use intersections::{
    IntersectingPair, SelfIntersections, faces_intersect, self_intersections, self_intersections_in,
};
pub use morton::morton_order;
pub use neighbours::{Neighbour, Neighbours};
pub use winding::{Winding, WindingNumber, winding_number};
