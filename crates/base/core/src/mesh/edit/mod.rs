//! Edits: each takes a mesh and returns another; the same arguments give the same bits.

mod merge;
mod noise;
mod random;
mod ripple;
mod shuffle;
mod subdivide;
mod transform;

pub use merge::{merge, unweld, without_unreferenced};
pub use noise::displace_at_random;
pub use random::Random;
pub use ripple::ripple;
pub use shuffle::shuffle;
pub use subdivide::subdivide;
pub use transform::{Affine, transform};
