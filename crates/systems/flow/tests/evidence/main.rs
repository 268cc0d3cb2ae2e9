//! Evidence that does not come from the code: closed forms and published values.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod derivatives;
mod flow;
#[cfg(feature = "figures")]
mod frames;
mod loops;
mod requests;
