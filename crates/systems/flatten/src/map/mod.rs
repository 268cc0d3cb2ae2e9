//! Maps of disks to the plane: convex boundaries, then free ones.

mod boundary;
mod convex;
mod energy;
mod newton;
mod reweight;
mod scaffold;
mod weights;

pub use boundary::ConvexBoundary;
pub(crate) use newton::{Descender, Descent};
pub(crate) use reweight::{Start, start_map};
pub use weights::Weights;
