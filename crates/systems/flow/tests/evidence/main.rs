//! Evidence that does not come from the code: closed forms and published values.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod flow;
