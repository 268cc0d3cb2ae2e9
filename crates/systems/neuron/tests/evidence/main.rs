//! Evidence for the results on neurons.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod checks;
mod cubics;
mod flows;
mod imports;
mod meshes;
mod skeletons;
mod steps;
mod stops;
mod transports;
mod walls;
