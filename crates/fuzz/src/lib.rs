//! Fuzz targets: functions of arbitrary bytes that must neither panic nor run without end, and that state what has to hold of the
//! result.
//!
//! Each target has a folder of inputs in `corpus`. The tests run all of them and some thousands of mutations on every change;
//! `bench/fuzz` runs the same targets with libFuzzer, guided by coverage, for as long as one likes. What either finds becomes a file of the
//! corpus.

#![allow(clippy::missing_panics_doc, reason = "a target panics where something does not hold")]

mod certificates;
mod engine;
mod meshes;
mod texts;

use std::path::{Path, PathBuf};

/// A function of arbitrary bytes.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, and that of its folder of inputs.
    pub name: &'static str,
    /// Panics if something does not hold.
    pub run: fn(&[u8]),
    /// Mutations that an ordinary test tries.
    pub usual: u32,
}

/// All targets.
pub const TARGETS: [Target; 9] = [
    Target { name: "meshes", run: meshes::run, usual: 3000 },
    Target { name: "certificates", run: certificates::run, usual: 1500 },
    Target { name: "engine", run: engine::distance, usual: 150 },
    Target { name: "deviation", run: engine::deviation, usual: 60 },
    Target { name: "skeletons", run: texts::skeleton, usual: 2000 },
    Target { name: "drawings", run: texts::drawing, usual: 2000 },
    Target { name: "pictures", run: texts::picture, usual: 1000 },
    Target { name: "options", run: texts::options, usual: 1000 },
    Target { name: "neuron-files", run: texts::neuron_files, usual: 2000 },
];

/// The target of this name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}

/// The folder of the inputs of a target.
pub fn corpus(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name)
}
