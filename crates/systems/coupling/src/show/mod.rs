//! Runs as pages that play.

mod drawn;
mod frames;
mod page;

pub use frames::{CoupleFrame, CoupleFrames};
pub use page::CouplePage;
