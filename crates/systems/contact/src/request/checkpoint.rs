//! A state on disk, from which a run goes on bit for bit.

use super::ContactScheme;
use crate::{Bodies, ContactError, ContactState, ContactStep, Simulation};
use pompeiu_core::request::hexadecimal;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// What a checkpoint holds: one JSON object, whose numbers are read back to the same doubles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The version of the program.
    version: String,
    /// SHA-256 of everything that bodies are made of.
    bodies: String,
    /// How steps are computed, as the answer says it.
    scheme: serde_json::Value,
    state: ContactState,
    /// What was measured after each step.
    steps: Vec<ContactStep>,
}

/// Why there is no state to go on from.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
    /// It belongs to other bodies.
    #[error("is of other bodies; name the scene and the meshes it was written for")]
    Bodies,
    /// It belongs to other options.
    #[error("was written with another `{0}`; give the same options and scene")]
    Scheme(String),
    /// The number of measured steps does not fit.
    #[error("has {found} measured steps, expected {expected}; the file is damaged")]
    Steps {
        /// Measured steps.
        found: usize,
        /// Steps of the state.
        expected: usize,
    },
    /// The state cannot be used.
    #[error("{0}; the file is damaged")]
    State(#[from] ContactError),
}

impl Checkpoint {
    /// The state of a run, with what was measured after each step.
    ///
    /// # Errors
    /// [`CheckpointError::Syntax`] if a number is not finite.
    pub fn new(simulation: &Simulation, steps: &[ContactStep]) -> Result<Self, CheckpointError> {
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            bodies: fingerprint(simulation.bodies()),
            scheme: value_of(simulation)?,
            state: simulation.state(),
            steps: steps.to_vec(),
        })
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// [`CheckpointError::Syntax`] if a number is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        serde_json::to_vec(self).map_err(|error| CheckpointError::Syntax(error.to_string()))
    }

    /// Goes to the state in the bytes of a checkpoint of the same bodies and options; gives what was measured before.
    ///
    /// # Errors
    /// [`CheckpointError`]; the simulation is then as before.
    pub fn resume(bytes: &[u8], simulation: &mut Simulation) -> Result<Vec<ContactStep>, CheckpointError> {
        let read: Self =
            serde_json::from_slice(bytes).map_err(|error| CheckpointError::Syntax(error.to_string()))?;
        let own = env!("CARGO_PKG_VERSION");
        if read.version != own {
            return Err(CheckpointError::Version { found: read.version, own });
        }
        if read.bodies != fingerprint(simulation.bodies()) {
            return Err(CheckpointError::Bodies);
        }
        if let Some(key) = different(&read.scheme, &value_of(simulation)?) {
            return Err(CheckpointError::Scheme(key));
        }
        let (found, expected) = (read.steps.len(), read.state.steps);
        if found != expected {
            return Err(CheckpointError::Steps { found, expected });
        }
        simulation.set_state(&read.state)?;
        Ok(read.steps)
    }
}

fn value_of(simulation: &Simulation) -> Result<serde_json::Value, CheckpointError> {
    let scheme = ContactScheme::new(simulation.options());
    serde_json::to_value(scheme).map_err(|error| CheckpointError::Syntax(error.to_string()))
}

/// The first key whose values differ.
fn different(a: &serde_json::Value, b: &serde_json::Value) -> Option<String> {
    let (a, b) = (a.as_object()?, b.as_object()?);
    a.keys().chain(b.keys()).find(|key| a.get(*key) != b.get(*key)).cloned()
}

/// SHA-256 of everything that bodies are made of. Numbers are written with the digits that tell doubles apart.
fn fingerprint(bodies: &Bodies) -> String {
    struct Hashing(Sha256);
    impl Write for Hashing {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut hashing = Hashing(Sha256::new());
    let _ = write!(hashing, "{bodies:?}");
    hexadecimal(&hashing.0.finalize())
}
