//! Geometry of simple shapes, one pair of shapes per file.

mod aabb;
mod foot;
mod frame;
pub mod point_triangle;

pub use aabb::Aabb;
pub use foot::Foot;
pub use frame::Frame;
