//! Fluids in the unit square, on a grid.

mod mac;
mod moves;
mod options;
mod sample;
mod simulation;
mod stam;

pub use options::{Edges, SquareDensity, SquareOptions, SquareScheme};
pub use simulation::{Square, SquareState};
