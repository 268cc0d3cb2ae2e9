//! Surfaces with known connectivity and geometry, and geodesics with known ends.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod delaunay;
mod homology;
mod paths;
mod surfaces;
mod tracing;
