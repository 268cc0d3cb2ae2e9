//! Surfaces whose connectivity and geometry are known, and walks on them with known ends.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod surfaces;
mod tracing;
