//! Evidence for what is said of neurons.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod meshes;
mod skeletons;
mod transports;
