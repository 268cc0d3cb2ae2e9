//! Exact predicates, and arithmetic whose results enclose the exact ones.

mod interval;
mod triangles;

pub use interval::Interval;
pub use triangles::common_point;
