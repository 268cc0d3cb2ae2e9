//! Choosing edges to cut, and opening the surface along them.

mod choose;
mod costs;
mod disk;
mod edges;
mod error;
mod farthest;
mod iterate;
mod open;
mod options;
mod skeleton;
mod tips;
mod tree;

pub use choose::choose_cut;
pub(crate) use choose::{first_cut, requested_edges};
pub(crate) use costs::Costs;
pub(crate) use disk::disk_cut;
pub(crate) use edges::edge_between;
pub use error::CutError;
pub use farthest::farthest_pair;
pub use open::{Opened, open};
pub use options::{CutOptions, CutStrategy};
pub(crate) use tips::tips;
pub(crate) use tree::GrowingCut;

/// The index of the first largest finite value; 0 if there is none.
pub(crate) fn largest(values: &[f64]) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (i, &value) in values.iter().enumerate() {
        if value.is_finite() && value > best.1 {
            best = (i, value);
        }
    }
    best.0
}
