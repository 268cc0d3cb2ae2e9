//! The command as people and scripts use it: what it says, what it finds, which files it writes.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and say what they skip")]

mod answers;
mod certificate;
mod common;
mod contract;
mod damaged;
mod deviation;
mod films;
mod guide;
mod many;
mod precision;
mod simplify;
mod transcripts;
