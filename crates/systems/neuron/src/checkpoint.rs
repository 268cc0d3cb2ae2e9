//! A state of transport on disk, from which a run goes on bit for bit.

use crate::{Parameters, TransportState};
use pompeiu_core::request::hexadecimal;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// What a checkpoint holds: one JSON object, whose numbers are read back to the same doubles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The version of the program.
    version: String,
    /// SHA-256 of the file and the options that make cells of it.
    mesh: String,
    /// SHA-256 of the parameters but for the number of steps.
    parameters: String,
    /// The state.
    pub state: TransportState,
}

/// What a run depends on: a state of another run is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunIdentity {
    mesh: String,
    parameters: String,
}

impl RunIdentity {
    /// The identity of a run over the cells that these options make of this file.
    pub fn new(content: &[u8], options: &str, parameters: &Parameters) -> Self {
        let mut hasher = Sha256::new();
        hasher.update(content);
        hasher.update(options);
        let mesh = hex(hasher);
        let mut hasher = Sha256::new();
        hasher.update(parameters.line());
        Self { mesh, parameters: hex(hasher) }
    }
}

/// Why there is no state to go on from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The bytes are no checkpoint.
    #[error("no checkpoint: {0}")]
    Syntax(String),
    /// Another version wrote it.
    #[error("written by version {found}, this is {own}; begin anew")]
    Version {
        /// The version that wrote it.
        found: String,
        /// This version.
        own: &'static str,
    },
    /// It belongs to other cells.
    #[error("is of other cells; name the same file with the same options")]
    Cells,
    /// It belongs to other parameters.
    #[error("was written with another configuration; only the number of steps may differ")]
    Parameters,
}

impl Checkpoint {
    /// The state of a run.
    pub fn new(run: &RunIdentity, state: TransportState) -> Self {
        let RunIdentity { mesh, parameters } = run.clone();
        Self { version: env!("CARGO_PKG_VERSION").to_owned(), mesh, parameters, state }
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// [`CheckpointError::Syntax`] if a number is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        serde_json::to_vec(self).map_err(|error| CheckpointError::Syntax(error.to_string()))
    }

    /// Reads the state of a run.
    ///
    /// # Errors
    /// [`CheckpointError`].
    pub fn from_bytes(bytes: &[u8], run: &RunIdentity) -> Result<Self, CheckpointError> {
        let read: Self =
            serde_json::from_slice(bytes).map_err(|error| CheckpointError::Syntax(error.to_string()))?;
        let own = env!("CARGO_PKG_VERSION");
        if read.version != own {
            return Err(CheckpointError::Version { found: read.version, own });
        }
        if read.mesh != run.mesh {
            return Err(CheckpointError::Cells);
        }
        if read.parameters != run.parameters {
            return Err(CheckpointError::Parameters);
        }
        Ok(read)
    }
}

fn hex(hasher: Sha256) -> String {
    hexadecimal(&hasher.finalize())
}
