//! Alignment and ranking against known motions and exhaustive computation.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod align;
mod rank;
mod register;
mod stopping;
