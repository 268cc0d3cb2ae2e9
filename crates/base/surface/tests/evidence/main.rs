//! Surfaces with known connectivity and geometry, and geodesics with known ends.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod surfaces;
mod tracing;
