//! Meshes that were read or made, by their numbers.

use crate::error::CallError;
use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::core::request::{FileFacts, Input};
use pompeiu::hausdorff::NamedFaces;
use serde_json::{Value, json};
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

/// An object of a reply, and the arrays beside it.
pub(crate) type Said = (Value, Vec<Vec<u8>>);

/// Meshes by their numbers.
#[derive(Default)]
pub(crate) struct Meshes {
    meshes: BTreeMap<u32, Loaded>,
    last: u32,
}

impl Meshes {
    /// Keeps a mesh, under a number of its own.
    pub(crate) fn keep(&mut self, loaded: Loaded) -> u32 {
        self.last += 1;
        self.meshes.insert(self.last, loaded);
        self.last
    }

    pub(crate) fn forget(&mut self, id: u32) {
        self.meshes.remove(&id);
    }

    /// What is said of a mesh that was read or made.
    pub(crate) fn facts(&self, id: u32) -> Result<Value, CallError> {
        let loaded = self.get(id)?;
        let bounds = Aabb::of_faces(&loaded.mesh);
        Ok(json!({
            "mesh": id, "input": loaded.input, "file": loaded.file,
            "groups": loaded.groups.iter().map(|group| &group.name).collect::<Vec<_>>(),
            "bounds": [bounds.lower, bounds.upper], "diagonal": bounds.diagonal(),
        }))
    }

    pub(crate) fn get(&self, id: u32) -> Result<&Loaded, CallError> {
        self.meshes.get(&id).ok_or(CallError::NoMesh(id))
    }
}
