//! A state on disk, from which a run goes on bit for bit.

use crate::square::{Square, SquareState};
use crate::{FluidError, FluidStep, SchemeReport, Simulation, State};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::{DataLengthError, FaceData, VertexData};
use pompeiu_core::request::hexadecimal;
use pompeiu_surface::EdgeData;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// What a checkpoint holds: one JSON object, whose numbers are read back to the same doubles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The version of the program.
    version: String,
    /// SHA-256 of positions and faces.
    mesh: String,
    /// How the flow is computed, as the answer says it.
    scheme: serde_json::Value,
    #[serde(flatten)]
    stored: Stored,
    /// What was measured, at first and after each step.
    steps: Vec<FluidStep>,
}

/// A state without what follows from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stored {
    /// Number of steps so far.
    pub step: usize,
    /// Time so far.
    pub time: f64,
    /// The arrays of the state by name.
    pub arrays: BTreeMap<String, Vec<f64>>,
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
    /// It belongs to another mesh.
    #[error("is of another mesh; name the mesh it was written for")]
    Mesh,
    /// It belongs to other options.
    #[error("was written with another `{0}`; give the same options and scene")]
    Scheme(String),
    /// The number of measured steps does not fit.
    #[error("has {found} measured steps, expected {expected}; the file is damaged")]
    Steps {
        /// Measured steps.
        found: usize,
        /// Steps of the state, and the beginning.
        expected: usize,
    },
    /// An array is missing.
    #[error("there is no array \"{0}\"; the file is damaged")]
    Array(String),
    /// An array has the wrong length.
    #[error("{0}; the file is damaged")]
    Length(#[from] DataLengthError),
    /// The state cannot be used.
    #[error(transparent)]
    State(#[from] FluidError),
}

impl Checkpoint {
    /// The state of a run on a mesh, with what was measured at first and after each step.
    ///
    /// # Errors
    /// [`CheckpointError::Syntax`] if a number is not finite.
    pub fn new(
        mesh: &TriMesh,
        scheme: &SchemeReport,
        stored: Stored,
        steps: &[FluidStep],
    ) -> Result<Self, CheckpointError> {
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            mesh: fingerprint(mesh),
            scheme: value_of(scheme)?,
            stored,
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

    /// Reads a state of a flow that is computed in this way on this mesh.
    ///
    /// # Errors
    /// [`CheckpointError`].
    pub fn from_bytes(bytes: &[u8], mesh: &TriMesh, scheme: &SchemeReport) -> Result<Self, CheckpointError> {
        let read: Self =
            serde_json::from_slice(bytes).map_err(|error| CheckpointError::Syntax(error.to_string()))?;
        let own = env!("CARGO_PKG_VERSION");
        if read.version != own {
            return Err(CheckpointError::Version { found: read.version, own });
        }
        if read.mesh != fingerprint(mesh) {
            return Err(CheckpointError::Mesh);
        }
        match different(&read.scheme, &value_of(scheme)?) {
            Some(key) => Err(CheckpointError::Scheme(key)),
            None => Ok(read),
        }
    }

    /// The state.
    pub fn stored(&self) -> &Stored {
        &self.stored
    }

    /// What was measured, at first and after each step.
    ///
    /// # Errors
    /// [`CheckpointError::Steps`] if the number of steps does not fit.
    pub fn steps(&self) -> Result<&[FluidStep], CheckpointError> {
        let (found, expected) = (self.steps.len(), self.stored.step.saturating_add(1));
        if found == expected { Ok(&self.steps) } else { Err(CheckpointError::Steps { found, expected }) }
    }
}

fn value_of(scheme: &SchemeReport) -> Result<serde_json::Value, CheckpointError> {
    serde_json::to_value(scheme).map_err(|error| CheckpointError::Syntax(error.to_string()))
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
    hexadecimal(&hasher.finalize())
}

impl Stored {
    fn array(&self, name: &str) -> Result<Vec<f64>, CheckpointError> {
        self.arrays.get(name).cloned().ok_or_else(|| CheckpointError::Array(name.to_owned()))
    }
}

impl Simulation<'_> {
    /// What a checkpoint holds of the state.
    pub fn store(&self) -> Stored {
        let state = self.state();
        let mut arrays = BTreeMap::from([
            ("vorticity".to_owned(), state.vorticity.to_vec()),
            ("harmonic".to_owned(), state.harmonic.clone()),
            ("edge velocity".to_owned(), state.edge_velocity.iter().flatten().copied().collect()),
        ]);
        for (i, values) in state.densities.iter().enumerate() {
            arrays.insert(format!("density {i}"), values.to_vec());
        }
        for (i, values) in state.face_densities.iter().enumerate() {
            arrays.insert(format!("density {i} on faces"), values.to_vec());
        }
        Stored { step: state.step, time: state.time, arrays }
    }

    /// Takes over what [`Simulation::store`] gave.
    ///
    /// # Errors
    /// [`CheckpointError`] if it does not fit.
    pub fn restore(&mut self, stored: &Stored) -> Result<(), CheckpointError> {
        let mesh = self.surface().mesh();
        let (vertices, faces) = (mesh.vertices(), mesh.faces());
        let state = self.state();
        let edges = stored.array("edge velocity")?;
        let densities = (0..state.densities.len())
            .map(|i| Ok(VertexData::new(vertices, stored.array(&format!("density {i}"))?)?));
        let face_densities = (0..state.face_densities.len())
            .map(|i| Ok(FaceData::new(faces, stored.array(&format!("density {i} on faces"))?)?));
        let state = State {
            step: stored.step,
            time: stored.time,
            vorticity: VertexData::new(vertices, stored.array("vorticity")?)?,
            harmonic: stored.array("harmonic")?,
            densities: densities.collect::<Result<_, CheckpointError>>()?,
            edge_velocity: EdgeData::new(
                state.edge_velocity.len(),
                edges.chunks_exact(2).map(|u| [u[0], u[1]]).collect(),
            )?,
            face_densities: face_densities.collect::<Result<_, CheckpointError>>()?,
            ..state.clone()
        };
        Ok(self.set_state(&state)?)
    }
}

impl Square {
    /// What a checkpoint holds of the state.
    pub fn store(&self) -> Stored {
        let SquareState { step, time, velocity: [u, v], densities } = self.state();
        let mut arrays =
            BTreeMap::from([("velocity along x".to_owned(), u), ("velocity along y".to_owned(), v)]);
        for (i, values) in densities.into_iter().enumerate() {
            arrays.insert(format!("density {i}"), values);
        }
        Stored { step, time, arrays }
    }

    /// Takes over what [`Square::store`] gave.
    ///
    /// # Errors
    /// [`CheckpointError`] if it does not fit.
    pub fn restore(&mut self, stored: &Stored) -> Result<(), CheckpointError> {
        let densities = (0..self.densities().len()).map(|i| stored.array(&format!("density {i}")));
        let densities = densities.collect::<Result<_, _>>()?;
        let velocity = [stored.array("velocity along x")?, stored.array("velocity along y")?];
        let (step, time) = (stored.step, stored.time);
        Ok(self.set_state(&SquareState { step, time, velocity, densities })?)
    }
}
