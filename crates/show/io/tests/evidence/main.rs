//! Readers and writers against those of other projects, and on defective files.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails by panicking, as the test does")]

mod formats;
mod readers;
mod writers;
