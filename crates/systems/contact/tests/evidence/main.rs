//! Evidence that does not come from the code: closed forms, invariants, differences, an exact test at every step.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod distances;
mod obstacles;
mod potential;
mod rest;
mod scenes;
