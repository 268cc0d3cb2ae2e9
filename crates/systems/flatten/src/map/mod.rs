//! Maps of disks to the plane: convex boundaries, then free ones.

mod arap;
mod boundary;
mod conformal;
mod convex;
mod energy;
mod newton;
mod reweight;
mod ring;
mod scaffold;
mod weights;

pub(crate) use arap::as_rigid_as_possible;
pub use boundary::ConvexBoundary;
pub(crate) use boundary::{Axis, LoopMirror, straight_sides};
pub use conformal::Conformal;
pub(crate) use conformal::conformal;
pub(crate) use newton::{Descender, Descent};
pub(crate) use reweight::{Start, StartOptions, start_map};
pub use ring::{RingKind, VirtualBoundary};
pub use weights::Weights;
