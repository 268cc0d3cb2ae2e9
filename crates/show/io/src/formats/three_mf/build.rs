//! The items of a build, with the objects that they are made of.

use super::model::{Model, Object, Reference};
use super::package::in_part;
use crate::error::{FormatError, Location};
use crate::expansion::Allowance;
use crate::formats::gltf::transform::Transform;
use crate::groups::Group;
use crate::raw::RawMesh;
use std::collections::HashMap;

/// How deep components may be nested: a chain that is longer is a circle.
const MOST_DEPTH: usize = 64;

/// What a visit of an object without a mesh costs of the allowance.
const VISIT: u64 = 64;

pub(super) struct Build<'m> {
    models: &'m HashMap<String, Model>,
    allowance: Allowance,
    mesh: RawMesh,
}

impl<'m> Build<'m> {
    pub(super) fn new(models: &'m HashMap<String, Model>, allowance: Allowance) -> Self {
        Self { models, allowance, mesh: RawMesh::default() }
    }

    pub(super) fn place(mut self, root: &str) -> Result<RawMesh, FormatError> {
        let model = &self.models[root];
        let mm = model.millimetres;
        let scale = Transform::from_rows([[mm, 0.0, 0.0, 0.0], [0.0, mm, 0.0, 0.0], [0.0, 0.0, mm, 0.0]]);
        for item in &model.items {
            let start = self.mesh.faces.len();
            let object = self.add(root, item, &scale, 0)?;
            let name = object.name.clone().unwrap_or_else(|| format!("object {}", item.object));
            let faces = start..self.mesh.faces.len();
            if !faces.is_empty() {
                self.mesh.groups.push(Group { name, faces });
            }
        }
        if model.items.is_empty() {
            return Err(in_part(root, "found no item in the build, expected at least one"));
        }
        Ok(self.mesh)
    }

    fn add(
        &mut self,
        part: &str,
        reference: &Reference,
        outer: &Transform,
        depth: usize,
    ) -> Result<&'m Object, FormatError> {
        let part = reference.part.as_deref().unwrap_or(part);
        let models = self.models;
        let object = models.get(part).and_then(|model| model.objects.get(&reference.object));
        let object = object.ok_or_else(|| {
            in_part(part, format!("found no object {}, which is referred to", reference.object))
        })?;
        if depth > MOST_DEPTH {
            let problem = format!("components are nested deeper than {MOST_DEPTH}, or in a circle");
            return Err(in_part(part, problem));
        }
        let transform = outer.after(&reference.transform);
        self.take(VISIT + 24 * object.positions.len() as u64 + 12 * object.faces.len() as u64)?;
        let base = self.mesh.positions.len() as u64;
        if base + object.positions.len() as u64 > u64::from(u32::MAX) {
            return Err(in_part(part, "found more vertices than 32-bit indices can name"));
        }
        self.mesh.positions.extend(object.positions.iter().map(|position| transform.apply(*position)));
        let mirrors = transform.mirrors();
        self.mesh.faces.extend(object.faces.iter().map(|corners| {
            let [a, b, c] = corners.map(|v| base as u32 + v);
            if mirrors { [a, c, b] } else { [a, b, c] }
        }));
        for component in &object.components {
            self.add(part, component, &transform, depth + 1)?;
        }
        Ok(object)
    }

    fn take(&mut self, bytes: u64) -> Result<(), FormatError> {
        self.allowance.take(bytes).map_err(|most| {
            let problem =
                format!("objects that are placed often grow beyond {most} bytes, expected fewer copies");
            FormatError::new(Location::File, problem)
        })
    }
}
