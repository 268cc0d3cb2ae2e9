//! Alignment and ranking against known motions and against all distances computed in full.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod align;
mod rank;
mod register;
mod stopping;
