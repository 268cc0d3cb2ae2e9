//! The calls about meshes, and what was found last.

use crate::ask;
use crate::call::{ArrayOf, Call};
use crate::error::CallError;
use crate::meshes::{Loaded, Meshes, Said};
use crate::outputs::{self, Found};
use crate::watch::Watcher;
use pompeiu::core::TriMesh;
use pompeiu::core::request::{FileFacts, Input, hexadecimal};
use pompeiu::hausdorff::NamedFaces;
use pompeiu::io::read_bytes_of;
use serde_json::json;
use sha2::{Digest, Sha256};

/// What comes back from a call.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reply {
    /// An object: with `error`, a sentence, where there is no answer.
    pub json: String,
    /// Arrays of bytes beside it, to which it refers by their places.
    pub arrays: Vec<Vec<u8>>,
}

/// Meshes, what was found of them last, and the answers to calls.
#[derive(Default)]
pub struct Engine {
    meshes: Meshes,
    found: Option<Found>,
}

impl Engine {
    /// Answers a call, an object of JSON with the name of the call under `call`; what cannot be answered is a reply with an `error`.
    pub fn call(&mut self, json: &str, arrays: Vec<Vec<u8>>, watcher: &dyn Watcher) -> Reply {
        let said = serde_json::from_str::<Call>(json)
            .map_err(CallError::from)
            .and_then(|call| self.answer(call, arrays, watcher));
        let (value, arrays) =
            said.unwrap_or_else(|error| (json!({ "error": error.to_string() }), Vec::new()));
        Reply { json: value.to_string(), arrays }
    }

    fn answer(&mut self, call: Call, arrays: Vec<Vec<u8>>, watcher: &dyn Watcher) -> Result<Said, CallError> {
        let bytes = |bytes: Vec<u8>| Ok((json!({}), vec![bytes]));
        match call {
            Call::Read { name } => {
                let [bytes] = exactly(arrays)?;
                self.read(name, &bytes)
            }
            Call::Mesh { name } => {
                let [positions, faces] = exactly(arrays)?;
                let mesh = TriMesh::new(
                    outputs::rows(&positions, f64::from_le_bytes)?,
                    outputs::rows(&faces, u32::from_le_bytes)?,
                )?;
                let id = self.meshes.keep(Loaded::of_mesh(mesh, &name));
                Ok((self.meshes.facts(id)?, Vec::new()))
            }
            Call::Ask(request) => {
                let (said, shown) = ask::ask(&mut self.meshes, &request, watcher)?;
                self.found = shown;
                Ok(said)
            }
            Call::Page { command_line } => {
                bytes(self.found()?.page(&self.meshes, command_line.as_deref())?.into_bytes())
            }
            Call::Document { command_line } => bytes(self.found()?.document(command_line.as_deref())?),
            Call::Drawing => bytes(self.found()?.drawing()?.into_bytes()),
            Call::Write { mesh, format } => bytes(outputs::file(self.meshes.get(mesh)?, &format)?),
            Call::Arrays { mesh } => {
                let mesh = &self.meshes.get(mesh)?.mesh;
                let arrays = vec![
                    outputs::bytes(mesh.positions(), f64::to_le_bytes),
                    outputs::bytes(mesh.faces(), u32::to_le_bytes),
                ];
                let of = |index, entries| ArrayOf { index, entries, columns: 3 };
                Ok((json!({ "arrays": { "positions": of(0, "f64"), "faces": of(1, "u32") } }), arrays))
            }
            Call::Forget { mesh } => {
                self.meshes.forget(mesh);
                Ok((json!({}), Vec::new()))
            }
            Call::Commands => {
                Ok((json!({ "version": env!("CARGO_PKG_VERSION"), "commands": ask::defaults() }), Vec::new()))
            }
        }
    }

    fn read(&mut self, name: String, bytes: &[u8]) -> Result<Said, CallError> {
        let read =
            read_bytes_of(&name, bytes).map_err(|problem| CallError::Read { name: name.clone(), problem })?;
        let sum = hexadecimal(&Sha256::digest(bytes));
        let file = FileFacts {
            format: read.format.to_string(),
            compressed: read.compressed,
            polygons_triangulated: read.polygons_triangulated,
            faces_dropped: read.faces_dropped,
        };
        let groups = read
            .groups
            .iter()
            .map(|group| NamedFaces { name: group.name.clone(), faces: group.faces.clone() });
        let groups = groups.collect();
        let input = Input { path: Some(name), sha256: Some(sum), ..Input::of_mesh(&read.mesh) };
        let id = self.meshes.keep(Loaded { mesh: read.mesh, input, file: Some(file), groups, texture: None });
        Ok((self.meshes.facts(id)?, Vec::new()))
    }

    fn found(&self) -> Result<&Found, CallError> {
        self.found.as_ref().ok_or(CallError::NothingFound("shown"))
    }
}

/// So many arrays.
fn exactly<const N: usize>(arrays: Vec<Vec<u8>>) -> Result<[Vec<u8>; N], CallError> {
    let found = arrays.len();
    arrays.try_into().map_err(|_| CallError::Arrays { found, expected: N })
}
