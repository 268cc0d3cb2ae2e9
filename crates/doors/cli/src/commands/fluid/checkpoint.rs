//! A state on disk, from which a run goes on bit for bit.

use super::stage::Stage;
use crate::files;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::fluid::FluidStep;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// What a checkpoint holds: one JSON object, whose numbers are read back to the same doubles.
#[derive(Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The version of the program.
    version: String,
    /// SHA-256 of positions and faces.
    mesh: String,
    /// How the flow is computed, as the answer says it.
    scheme: serde_json::Value,
    step: usize,
    time: f64,
    /// The arrays of the state by name.
    arrays: BTreeMap<String, Vec<f64>>,
    /// What was measured, at first and after each step.
    pub(super) steps: Vec<FluidStep>,
}

impl Checkpoint {
    /// Writes the state of a run.
    pub(super) fn write(
        path: &Path,
        stage: &Stage<'_>,
        mesh: &TriMesh,
        steps: &[FluidStep],
        printer: &Printer,
    ) -> anyhow::Result<()> {
        let (step, time, arrays) = stage.save();
        let scheme = serde_json::to_value(stage.scheme())?;
        let (version, mesh) = (env!("CARGO_PKG_VERSION").to_owned(), fingerprint(mesh));
        let checkpoint = Self { version, mesh, scheme, step, time, arrays, steps: steps.to_vec() };
        files::write_whole(path, &serde_json::to_vec(&checkpoint)?, printer)
    }

    /// Reads a state and takes it over.
    pub(super) fn resume(path: &Path, stage: &mut Stage<'_>, mesh: &TriMesh) -> anyhow::Result<Self> {
        let shown = || path.display().to_string();
        files::check_readable(path)?;
        let text = std::fs::read(path).with_context(shown)?;
        let read: Self =
            serde_json::from_slice(&text).with_context(|| format!("{}: no checkpoint", shown()))?;
        let own = env!("CARGO_PKG_VERSION");
        if read.version != own {
            bail!("{}: written by version {}, this is {own}; begin anew", shown(), read.version);
        }
        if read.mesh != fingerprint(mesh) {
            bail!("{}: is of another mesh; name the mesh it was written for", shown());
        }
        let scheme = serde_json::to_value(stage.scheme())?;
        if let Some(key) = different(&read.scheme, &scheme) {
            bail!("{}: was written with another `{key}`; give the same options and scene", shown());
        }
        if read.steps.len() != read.step + 1 {
            let (found, expected) = (read.steps.len(), read.step + 1);
            bail!("{}: has {found} measured steps, expected {expected}; the file is damaged", shown());
        }
        stage.restore(read.step, read.time, &read.arrays).with_context(shown)?;
        Ok(read)
    }
}

/// The first key whose values differ.
fn different(a: &serde_json::Value, b: &serde_json::Value) -> Option<String> {
    let (a, b) = (a.as_object()?, b.as_object()?);
    a.keys().chain(b.keys()).find(|key| a.get(*key) != b.get(*key)).cloned()
}

/// SHA-256 of positions and faces.
fn fingerprint(mesh: &TriMesh) -> String {
    let mut hasher = Sha256::new();
    for x in mesh.positions().iter().flatten() {
        hasher.update(x.to_le_bytes());
    }
    for corner in mesh.faces().iter().flatten() {
        hasher.update(corner.to_le_bytes());
    }
    files::hex(hasher)
}
