//! Arithmetic whose results enclose the exact ones.

mod interval;

pub use interval::Interval;
