//! Runs as pages that play.

mod frames;
mod page;

pub use frames::{ContactFrame, ContactFrames};
pub use page::ContactPage;
