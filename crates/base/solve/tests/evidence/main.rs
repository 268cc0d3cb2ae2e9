//! Evidence that does not come from the code: known solutions, dense arithmetic, other solvers.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod assembly;
mod fronts;
mod solvers;
mod sparse;
