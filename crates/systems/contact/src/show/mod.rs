//! Runs as pages that play.

mod frames;
mod page;

pub use frames::{ContactFrame, most_frames};
pub use page::ContactPage;
