//! Readers and writers against those of other people, and on files that are not as they should be.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod formats;
mod readers;
mod writers;
