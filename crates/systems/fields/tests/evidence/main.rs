//! Evidence that does not come from the code: dimensions, known parts.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and say what they skip")]

#[path = "../../../../base/operators/tests/evidence/common.rs"]
#[allow(dead_code, reason = "shared with the tests of operators, which need more of it")]
mod common;
mod compare;
mod decomposition;
mod dimensions;
#[cfg(feature = "figures")]
mod page;
mod single_space;
