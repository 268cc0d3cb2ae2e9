//! What the verifier promises, held against exact arithmetic, and what it reads.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, fail")]

mod attack;
mod command;
mod kernels;
mod readers;
