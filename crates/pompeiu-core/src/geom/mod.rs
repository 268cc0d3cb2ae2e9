//! Geometry of simple shapes, one pair to a file.

mod aabb;
mod frame;
pub mod point_triangle;

pub use aabb::Aabb;
pub use frame::Frame;
