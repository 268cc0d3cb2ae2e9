//! Rounded arithmetic against exact arithmetic.

mod frames_and_covers;
mod interval;
mod point_triangle;
