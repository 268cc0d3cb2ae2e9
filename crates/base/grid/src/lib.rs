//! Incompressible velocities on the sides of square cells (marker and cell), and values on lattices.
//!
//! # Source
//! `harlow_numerical_1965`.

mod lattice;
mod mac;

pub use lattice::Lattice;
pub use mac::{Mac, MacGrid, Side};
