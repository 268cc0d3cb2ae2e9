//! Transport as an animated page.

mod page;
mod surface;

pub use page::NeuronPage;
pub use surface::NeuronSurface;
