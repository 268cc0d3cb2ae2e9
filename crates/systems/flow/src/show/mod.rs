//! Flows and remeshed surfaces as pages, and as pictures.

mod frames;
mod page;
mod remeshed;

pub use frames::{Frame, Frames};
pub use page::FlowPage;
pub use remeshed::RemeshPage;
