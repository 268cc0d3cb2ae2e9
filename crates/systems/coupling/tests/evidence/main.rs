//! Evidence that does not come from the code: closed forms, references that solve both problems at once, published iteration counts.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod channel;
mod linear;
mod piston;
#[cfg(feature = "figures")]
mod show;
mod tube;
