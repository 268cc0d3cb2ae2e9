//! Meshes that were read, what was found of them last, and the calls about them.

use crate::ask;
use crate::call::{ArrayOf, Call};
use crate::error::CallError;
use crate::outputs::{self, Found};
use crate::watch::Watcher;
use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::core::request::{FileFacts, Input, hexadecimal};
use pompeiu::hausdorff::NamedFaces;
use pompeiu::io::read_bytes_of;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// A mesh with what is known of its file.
pub(crate) struct Loaded {
    pub(crate) mesh: TriMesh,
    pub(crate) input: Input,
    pub(crate) file: Option<FileFacts>,
    pub(crate) groups: Vec<NamedFaces>,
    pub(crate) texture: Option<Texture>,
}

/// Texture coordinates of a mesh.
pub(crate) struct Texture {
    pub(crate) coordinates: Vec<[f64; 2]>,
    pub(crate) corners: Vec<[u32; 3]>,
}

impl Loaded {
    /// A mesh that is in no file.
    pub(crate) fn of_mesh(mesh: TriMesh, name: &str) -> Self {
        let path = Some(name.to_owned()).filter(|name| !name.is_empty());
        let input = Input { path, ..Input::of_mesh(&mesh) };
        Self { mesh, input, file: None, groups: Vec::new(), texture: None }
    }

    /// What it is called.
    pub(crate) fn name(&self) -> &str {
        self.input.path.as_deref().unwrap_or("mesh")
    }
}

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
    meshes: BTreeMap<u32, Loaded>,
    last: u32,
    found: Option<Found>,
}

/// An object of a reply, and the arrays beside it.
pub(crate) type Said = (Value, Vec<Vec<u8>>);

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
                let id = self.keep(Loaded::of_mesh(mesh, &name));
                Ok((self.facts(id)?, Vec::new()))
            }
            Call::Ask(request) => ask::ask(self, &request, watcher),
            Call::Page { command_line } => {
                bytes(self.found()?.page(self, command_line.as_deref())?.into_bytes())
            }
            Call::Document { command_line } => bytes(self.found()?.document(command_line.as_deref())?),
            Call::Drawing => bytes(self.found()?.drawing()?.into_bytes()),
            Call::Write { mesh, format } => bytes(outputs::file(self.mesh(mesh)?, &format)?),
            Call::Arrays { mesh } => {
                let mesh = &self.mesh(mesh)?.mesh;
                let arrays = vec![
                    outputs::bytes(mesh.positions(), f64::to_le_bytes),
                    outputs::bytes(mesh.faces(), u32::to_le_bytes),
                ];
                let of = |index, entries| ArrayOf { index, entries, columns: 3 };
                Ok((json!({ "arrays": { "positions": of(0, "f64"), "faces": of(1, "u32") } }), arrays))
            }
            Call::Forget { mesh } => {
                self.meshes.remove(&mesh);
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
        let id = self.keep(Loaded { mesh: read.mesh, input, file: Some(file), groups, texture: None });
        Ok((self.facts(id)?, Vec::new()))
    }

    /// Keeps a mesh, under a number of its own.
    pub(crate) fn keep(&mut self, loaded: Loaded) -> u32 {
        self.last += 1;
        self.meshes.insert(self.last, loaded);
        self.last
    }

    /// Keeps what is to be shown next.
    pub(crate) fn show(&mut self, found: Option<Found>) {
        self.found = found;
    }

    /// What is said of a mesh that was read or made.
    pub(crate) fn facts(&self, id: u32) -> Result<Value, CallError> {
        let loaded = self.mesh(id)?;
        let bounds = Aabb::of_faces(&loaded.mesh);
        Ok(json!({
            "mesh": id, "input": loaded.input, "file": loaded.file,
            "groups": loaded.groups.iter().map(|group| &group.name).collect::<Vec<_>>(),
            "bounds": [bounds.lower, bounds.upper], "diagonal": bounds.diagonal(),
        }))
    }

    pub(crate) fn mesh(&self, id: u32) -> Result<&Loaded, CallError> {
        self.meshes.get(&id).ok_or(CallError::NoMesh(id))
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
