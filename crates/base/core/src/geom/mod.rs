//! Geometry of simple shapes, one pair of shapes per file.

mod aabb;
mod eigen;
mod foot;
mod frame;
pub mod point_triangle;
mod turn;

pub use aabb::Aabb;
pub use eigen::{eigenpairs, eigenvectors};
pub use foot::Foot;
pub use frame::Frame;
