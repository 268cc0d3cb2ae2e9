//! Pages and pictures as files.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod films;
mod page;
mod pictures;
