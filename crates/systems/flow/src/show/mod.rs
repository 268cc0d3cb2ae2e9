//! A flow as a page that plays it, and as a picture.

mod frames;
mod page;

pub use frames::{Frame, Frames};
pub use page::FlowPage;
