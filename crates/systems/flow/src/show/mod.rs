//! Flows as pages, and as pictures.

mod frames;
mod page;

pub use frames::{Frame, Frames};
pub use page::FlowPage;
