//! Flows as pages, and as pictures.

mod frames;
mod page;
mod streaks;

pub use frames::{FluidFrame, most_frames};
pub use page::FluidPage;
pub use streaks::Streaks;
