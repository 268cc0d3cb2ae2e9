//! Evidence that does not come from the code: closed forms, identities, dimensions, planted parts.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and say what they skip")]

mod common;
mod fields;
mod harmonic;
mod heat;
mod identities;
mod laplacian;
