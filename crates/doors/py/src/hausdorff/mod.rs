//! How far two meshes are from each other.

mod analysis;
mod distance;
mod page;

pub(crate) use distance::{Target, limits};
pub(crate) use page::DeviationPage;
