//! Collecting triangles from the nodes of a scene.

use super::accessor;
use super::buffers::Buffers;
use super::document::{Document, Mesh, Primitive, entry, wrong};
use super::transform::Transform;
use crate::error::{FormatError, Location};
use crate::expansion::most_bytes;
use crate::groups::Group;
use crate::raw::RawMesh;
use std::collections::HashMap;

/// Instances may take this many bytes in a file of any size.
const INSTANCES_FLOOR: u64 = 1 << 28;

/// Cost in bytes of showing a primitive, in addition to its content: about what can be processed in the same time.
const PRIMITIVE_BYTES: u64 = 256;

pub(super) fn read(
    document: &Document,
    buffers: &Buffers<'_>,
    file_length: u64,
) -> Result<RawMesh, FormatError> {
    let mut scene = SceneReader { document, buffers, raw: RawMesh::default(), file_length, spent: 0 };
    if document.nodes.is_empty() {
        // A library of meshes without a scene.
        for (index, mesh) in document.meshes.iter().enumerate() {
            let first = scene.raw.faces.len();
            scene.add_mesh(index, mesh, &Transform::IDENTITY)?;
            scene.group(mesh.name.as_deref(), first);
        }
        return Ok(scene.raw);
    }
    let mut visited = vec![false; document.nodes.len()];
    let enter = |node, parent| Step::Enter { node, parent };
    let mut pending: Vec<Step> =
        roots(document)?.into_iter().rev().map(|node| enter(node, Transform::IDENTITY)).collect();
    while let Some(step) = pending.pop() {
        let (index, parent) = match step {
            Step::Enter { node, parent } => (node, parent),
            Step::Leave { node, first } => {
                let node = entry(&document.nodes, "node", node)?;
                let mesh = node.mesh.and_then(|mesh| document.meshes.get(mesh));
                scene.group(node.name.as_deref().or(mesh.and_then(|mesh| mesh.name.as_deref())), first);
                continue;
            }
        };
        let node = entry(&document.nodes, "node", index)?;
        if std::mem::replace(&mut visited[index], true) {
            return Err(wrong(format!("node {index} is a child twice, expected trees of nodes")));
        }
        let own = Transform::of_node(node)
            .ok_or_else(|| wrong(format!("node {index} has a transform that is not affine")))?;
        let transform = parent.after(&own);
        pending.push(Step::Leave { node: index, first: scene.raw.faces.len() });
        if let Some(mesh) = node.mesh {
            scene.add_mesh(mesh, entry(&document.meshes, "mesh", mesh)?, &transform)?;
        }
        pending.extend(node.children.iter().rev().map(|&child| enter(child, transform)));
    }
    Ok(scene.raw)
}

/// A step of the traversal: a node's mesh and children, then the node's name for all their faces.
enum Step {
    Enter { node: usize, parent: Transform },
    Leave { node: usize, first: usize },
}

/// The roots of the default scene, else of the first, else all nodes without a parent.
fn roots(document: &Document) -> Result<Vec<usize>, FormatError> {
    if let Some(scene) = document.scene {
        return Ok(entry(&document.scenes, "scene", scene)?.nodes.clone());
    }
    if let Some(scene) = document.scenes.first() {
        return Ok(scene.nodes.clone());
    }
    let mut is_root = vec![true; document.nodes.len()];
    for &child in document.nodes.iter().flat_map(|node| &node.children) {
        if let Some(root) = is_root.get_mut(child) {
            *root = false;
        }
    }
    Ok((0..is_root.len()).filter(|&node| is_root[node]).collect())
}

struct SceneReader<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    raw: RawMesh,
    file_length: u64,
    /// Bytes of the mesh so far.
    spent: u64,
}

impl SceneReader<'_> {
    /// Records a group for the faces from `first` on, if there are any and the node has a name.
    fn group(&mut self, name: Option<&str>, first: usize) {
        let faces = first..self.raw.faces.len();
        if let Some(name) = name.filter(|_| !faces.is_empty()) {
            self.raw.groups.push(Group { name: name.to_owned(), faces });
        }
    }

    fn add_mesh(&mut self, index: usize, mesh: &Mesh, transform: &Transform) -> Result<(), FormatError> {
        // Primitives of one mesh often differ only in material and share their vertices.
        let mut bases = HashMap::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            self.spend(PRIMITIVE_BYTES)?;
            let Some(position) = primitive.attributes.position else { continue };
            let known = bases.get(&position).copied();
            let (base, count) = known.map_or_else(|| self.add_positions(position, transform), Ok)?;
            bases.insert(position, (base, count));
            self.add_triangles(primitive, base, count, transform.mirrors()).map_err(|error| FormatError {
                problem: in_primitive(index, number, &error.problem),
                ..error
            })?;
        }
        Ok(())
    }

    /// The index of the first added position, and their number.
    fn add_positions(&mut self, index: usize, transform: &Transform) -> Result<(u32, u32), FormatError> {
        let accessor = entry(&self.document.accessors, "accessor", index)?;
        let base = self.raw.positions.len();
        let positions = accessor::positions(self.buffers, accessor, index)?;
        self.spend(size_of_val(&positions[..]) as u64)?;
        if u32::try_from(base + positions.len()).is_err() {
            return Err(wrong(format!("more than {} vertices", u32::MAX)));
        }
        self.raw.positions.extend(positions.iter().map(|&position| transform.apply(position)));
        Ok((base as u32, positions.len() as u32))
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        base: u32,
        vertices: u32,
        mirrored: bool,
    ) -> Result<(), FormatError> {
        let indices = match primitive.indices {
            Some(index) => {
                let accessor = entry(&self.document.accessors, "accessor", index)?;
                Some(accessor::indices(self.buffers, accessor, index)?)
            }
            None => None,
        };
        let count = indices.as_ref().map_or(vertices as usize, Vec::len);
        self.spend((count * size_of::<u32>()) as u64)?;
        let triangles = match primitive.mode {
            0..=3 => {
                // Points, line segments, line loops and line strips.
                let shapes = [count, count / 2, count.saturating_sub(1), count.saturating_sub(1)];
                self.raw.faces_dropped += shapes[primitive.mode as usize] as u64;
                return Ok(());
            }
            4 if !count.is_multiple_of(3) => {
                return Err(wrong(format!("{count} corners, expected three for each triangle")));
            }
            4 => count / 3,
            5 | 6 => count.saturating_sub(2),
            mode => return Err(wrong(format!("unknown mode {mode}"))),
        };
        self.spend((triangles * size_of::<[u32; 3]>()) as u64)?;
        let indices = indices.as_deref();
        let vertex = |corner: usize| indices.map_or(corner as u32, |indices| indices[corner]);
        self.raw.faces.reserve(triangles);
        for t in 0..triangles {
            let [a, b, c] = match primitive.mode {
                4 => [3 * t, 3 * t + 1, 3 * t + 2],
                5 => [t, t + 1 + t % 2, t + 2 - t % 2],
                _ => [t + 1, t + 2, 0],
            }
            .map(vertex);
            if let Some(index) = [a, b, c].into_iter().find(|&v| v >= vertices) {
                let face = Location::Face(self.raw.faces.len() as u64);
                let problem = format!("vertex {index} does not exist, there are {vertices} (the first is 0)");
                return Err(FormatError::new(face, problem));
            }
            // A mirror reverses the orientation of triangles.
            let face = if mirrored { [a, c, b] } else { [a, b, c] };
            self.raw.faces.push(face.map(|v| base + v));
        }
        Ok(())
    }

    /// Accounts for what is about to be added. Content is bounded by the bytes in the file, but nodes may show the same mesh any
    /// number of times.
    fn spend(&mut self, bytes: u64) -> Result<(), FormatError> {
        self.spent = self.spent.saturating_add(bytes);
        let described_by = self.file_length.saturating_add(self.buffers.loaded_bytes());
        let most = most_bytes(described_by).max(INSTANCES_FLOOR);
        if self.spent <= most {
            return Ok(());
        }
        Err(wrong(format!(
            "the nodes show meshes so often that they take more than {most} bytes, the most that a file of this size may hold"
        )))
    }
}

fn in_primitive(mesh: usize, primitive: usize, problem: &str) -> String {
    format!("mesh {mesh}, primitive {primitive}: {problem}")
}
