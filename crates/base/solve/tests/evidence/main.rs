//! Solvers against known solutions.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod solvers;
