//! Evidence that does not come from the code: random operations, inverses, proven distances.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod operations;
mod simplification;
