//! What documents and pictures of the repository say, held against the repository.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod architecture;
mod circles;
mod pictures;
