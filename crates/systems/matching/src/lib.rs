//! Comparing one mesh with many.
//!
//! | module | question |
//! |---|---|
//! | [`align`] | which rigid motion brings one mesh onto another? A local optimum, not proven. |
//! | [`request`] | all that can be asked, as the command and Python offer it |
//! | [`rank`] | which of many meshes is nearest to a template? Ranks follow from proven enclosures alone. |
//! | [`matrix`] | how far apart is each pair of several meshes? Every entry is a proven enclosure. |

/// The version of the algorithms behind the results of tasks. It is increased whenever the same task gives another result, so that
/// results of two versions are never mixed.
pub const ALGORITHM: u32 = 2;

pub mod align;
pub mod matrix;
mod meshes;
pub mod rank;
pub mod request;
mod tasks;

pub use meshes::{Meshes, Unusable};
pub use tasks::{TaskObserver, TaskProgress};
