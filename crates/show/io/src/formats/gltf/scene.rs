//! Collecting triangles from the nodes of a scene.

use super::accessor;
use super::buffers::Buffers;
use super::document::{Document, Mesh, Primitive, entry, wrong};
use super::look::Look;
use super::numbers;
use super::transform::Transform;
use crate::error::{FormatError, Location};
use crate::expansion::most_bytes;
use crate::groups::Group;
use crate::raw::RawMesh;
use crate::weld::Welder;
use std::collections::{BTreeMap, HashMap};

/// Instances may take this many bytes in a file of any size.
const INSTANCES_FLOOR: u64 = 1 << 28;

/// Cost in bytes of showing a primitive, in addition to its content: about what can be processed in the same time.
const PRIMITIVE_BYTES: u64 = 256;

/// The mesh, and into `look` how it looks.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers<'_>,
    file_length: u64,
    look: Option<&mut Look>,
) -> Result<RawMesh, FormatError> {
    let (raw, welder) = (RawMesh::default(), Welder::default());
    let numbered = HashMap::new();
    let mut scene = SceneReader { document, buffers, raw, look, welder, numbered, file_length, spent: 0 };
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

/// The vertices of a primitive.
struct Vertices {
    /// The vertex of the mesh that each became.
    welded: Vec<u32>,
    /// The number of the first among all vertices that the scene shows.
    first_shown: u32,
}

struct SceneReader<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    raw: RawMesh,
    look: Option<&'a mut Look>,
    /// The positions of the mesh that is being added.
    welder: Welder,
    /// Its vertices that have numbers.
    numbered: HashMap<([u64; 3], u32), u32>,
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

    /// Adds a mesh as one node shows it. Equal positions become one vertex: where normals, texture coordinates or materials jump, the
    /// file has to have several.
    fn add_mesh(&mut self, index: usize, mesh: &Mesh, transform: &Transform) -> Result<(), FormatError> {
        // Primitives of one mesh often differ only in material and share their vertices.
        let mut known: HashMap<&BTreeMap<String, usize>, Vertices> = HashMap::new();
        self.welder.clear();
        self.numbered.clear();
        let first = self.raw.positions.len() as u32;
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            self.spend(PRIMITIVE_BYTES)?;
            let Some(position) = primitive.attributes.of("POSITION") else { continue };
            let attributes = &primitive.attributes.0;
            if !known.contains_key(attributes) {
                known.insert(attributes, self.add_vertices(primitive, position, transform, first)?);
            }
            self.add_triangles(primitive, &known[attributes], transform.mirrors()).map_err(|error| {
                FormatError { problem: in_primitive(index, number, &error.problem), ..error }
            })?;
        }
        Ok(())
    }

    /// Adds the vertices of a primitive; those of its mesh begin at `first`.
    fn add_vertices(
        &mut self,
        primitive: &Primitive,
        position: usize,
        transform: &Transform,
        first: u32,
    ) -> Result<Vertices, FormatError> {
        let accessor = entry(&self.document.accessors, "accessor", position)?;
        let positions = accessor::positions(self.buffers, accessor, position)?;
        self.spend((size_of_val(&positions[..]) + positions.len() * size_of::<u32>()) as u64)?;
        let first_shown = self.look.as_ref().map_or(0, |look| look.vertices());
        if u32::try_from(self.raw.positions.len().max(first_shown) + positions.len()).is_err() {
            return Err(wrong(format!("more than {} vertices", u32::MAX)));
        }
        let numbers = numbers::read(self.document, self.buffers, primitive, positions.len())?;
        self.spend(size_of_val(&numbers[..]) as u64)?;
        // Nothing but positions gives no reason to have one twice, but that they are different vertices.
        let is_bare = primitive.attributes.0.len() == 1 && primitive.indices.is_some();
        let mut welded = Vec::with_capacity(positions.len());
        for (v, &position) in positions.iter().enumerate() {
            let position = transform.apply(position);
            let is_finite = position.iter().all(|x| x.is_finite());
            let index = first
                + match numbers.get(v) {
                    Some(number) => {
                        let key = (position.map(|x| (x + 0.0).to_bits()), *number);
                        *self.numbered.entry(key).or_insert_with(|| self.welder.index_apart(position))
                    }
                    None if is_finite && !is_bare => self.welder.index(position),
                    None => self.welder.index_apart(position),
                };
            if index as usize == self.raw.positions.len() {
                self.raw.positions.push(position);
            }
            welded.push(index);
        }
        if let Some(bytes) = self.look.as_ref().map(|look| look.bytes(primitive, positions.len())) {
            self.spend(bytes)?;
        }
        if let Some(look) = &mut self.look {
            look.add_vertices(self.document, self.buffers, primitive, transform, positions.len())?;
        }
        Ok(Vertices { welded, first_shown: first_shown as u32 })
    }

    fn add_triangles(
        &mut self,
        primitive: &Primitive,
        vertices: &Vertices,
        mirrored: bool,
    ) -> Result<(), FormatError> {
        let number = vertices.welded.len() as u32;
        let indices = match primitive.indices {
            Some(index) => {
                let accessor = entry(&self.document.accessors, "accessor", index)?;
                Some(accessor::indices(self.buffers, accessor, index)?)
            }
            None => None,
        };
        let count = indices.as_ref().map_or(number as usize, Vec::len);
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
        let of_look = if self.look.is_some() { size_of::<[u32; 4]>() } else { 0 };
        self.spend((triangles * (size_of::<[u32; 3]>() + of_look)) as u64)?;
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
            if let Some(index) = [a, b, c].into_iter().find(|&v| v >= number) {
                let face = Location::Face(self.raw.faces.len() as u64);
                let problem = format!("vertex {index} does not exist, there are {number} (the first is 0)");
                return Err(FormatError::new(face, problem));
            }
            // A mirror reverses the orientation of triangles.
            let face = if mirrored { [a, c, b] } else { [a, b, c] };
            self.raw.faces.push(face.map(|v| vertices.welded[v as usize]));
            if let Some(look) = &mut self.look {
                look.add_face(face.map(|v| vertices.first_shown + v), primitive);
            }
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
