//! Rounded arithmetic against exact arithmetic.

mod interval;
mod point_triangle;
