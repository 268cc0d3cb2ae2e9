//! Evidence that does not come from the code: closed forms, brute force, damaged files.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod files;
mod geometry;
