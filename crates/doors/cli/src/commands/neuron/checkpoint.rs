//! A state of transport on disk, from which a run goes on bit for bit.

use crate::files;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::neuron::{Parameters, TransportState};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;

/// What a checkpoint holds: one JSON object, whose numbers are read back to the same doubles.
#[derive(Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The version of the program.
    version: String,
    /// SHA-256 of the file and the options that make cells of it.
    mesh: String,
    /// SHA-256 of the parameters but for the number of steps.
    parameters: String,
    pub(super) state: TransportState,
}

impl Checkpoint {
    /// Writes the state of a run over a mesh with this fingerprint.
    pub(super) fn write(
        path: &Path,
        mesh: &str,
        parameters: &Parameters,
        state: TransportState,
        printer: &Printer,
    ) -> anyhow::Result<()> {
        let (version, mesh) = (env!("CARGO_PKG_VERSION").to_owned(), mesh.to_owned());
        let checkpoint = Self { version, mesh, parameters: without_steps(parameters), state };
        files::write_whole(path, &serde_json::to_vec(&checkpoint)?, printer)
    }

    /// Reads a state for a mesh with this fingerprint.
    pub(super) fn read(path: &Path, mesh: &str, parameters: &Parameters) -> anyhow::Result<Self> {
        let shown = || path.display().to_string();
        files::check_readable(path)?;
        let text = std::fs::read(path).with_context(shown)?;
        let read: Self =
            serde_json::from_slice(&text).with_context(|| format!("{}: no checkpoint", shown()))?;
        let own = env!("CARGO_PKG_VERSION");
        if read.version != own {
            bail!("{}: written by version {}, this is {own}; begin anew", shown(), read.version);
        }
        if read.mesh != mesh {
            bail!("{}: is of other cells; name the same file with the same options", shown());
        }
        if read.parameters != without_steps(parameters) {
            bail!("{}: was written with another configuration; only the number of steps may differ", shown());
        }
        Ok(read)
    }
}

fn without_steps(parameters: &Parameters) -> String {
    let mut hasher = Sha256::new();
    hasher.update(parameters.line());
    files::hex(hasher)
}

/// A fingerprint of a file and of the options that make cells of it.
pub(super) fn fingerprint(input: &Path, options: &str) -> anyhow::Result<String> {
    let bytes = std::fs::read(input).with_context(|| input.display().to_string())?;
    let mut hasher = Sha256::new();
    hasher.update(bytes);
    hasher.update(options);
    Ok(files::hex(hasher))
}
