//! Fluids in the unit square, on a grid.

mod moves;
mod options;
mod simulation;
mod stam;

pub use options::{Edges, SquareDensity, SquareOptions, SquareScheme};
pub use simulation::{Square, SquareState};
