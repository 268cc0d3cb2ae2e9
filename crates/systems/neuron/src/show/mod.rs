//! Transport as a page that plays it.

mod page;
mod surface;

pub use page::NeuronPage;
pub use surface::NeuronSurface;
