//! The parts of a glTF 2.0 document that describe triangles.

use crate::error::{FormatError, Location};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use std::collections::BTreeMap;

type Extensions = BTreeMap<String, Value>;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub(super) asset: Asset,
    #[serde(default)]
    pub(super) extensions_required: Vec<String>,
    pub(super) scene: Option<usize>,
    #[serde(default)]
    pub(super) scenes: Vec<Scene>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub(super) buffers: Vec<Buffer>,
    #[serde(default)]
    pub(super) materials: Vec<Value>,
    #[serde(default)]
    pub(super) textures: Vec<Value>,
    #[serde(default)]
    pub(super) samplers: Vec<Value>,
    #[serde(default)]
    pub(super) images: Vec<Value>,
    #[serde(default)]
    pub(super) animations: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) skins: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) cameras: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) extensions: Extensions,
}

#[derive(Debug, Deserialize)]
pub(super) struct Asset {
    pub(super) version: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Node {
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    /// Column by column.
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    /// A quaternion, real part last.
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) name: Option<String>,
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
    pub(super) material: Option<usize>,
    #[serde(default)]
    pub(super) targets: Vec<IgnoredAny>,
}

const fn triangles() -> u32 {
    4
}

/// Accessors by the names of what they hold, such as `POSITION`.
#[derive(Debug, Deserialize)]
#[serde(transparent)]
pub(super) struct Attributes(pub(super) BTreeMap<String, usize>);

impl Attributes {
    pub(super) fn of(&self, name: &str) -> Option<usize> {
        self.0.get(name).copied()
    }
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<Sparse>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Sparse {
    pub(super) count: u64,
    pub(super) indices: SparseArray,
    pub(super) values: SparseArray,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseArray {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    /// The type of the indices; the values have the type of the accessor.
    pub(super) component_type: Option<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    pub(super) byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: u64,
    #[serde(default)]
    pub(super) extensions: Extensions,
}

/// The list entry with this index, or an error that says what is missing.
pub(super) fn entry<'a, T>(list: &'a [T], what: &str, index: usize) -> Result<&'a T, FormatError> {
    list.get(index).ok_or_else(|| wrong(format!("{what} {index} does not exist, there are {}", list.len())))
}

pub(super) fn wrong(problem: String) -> FormatError {
    FormatError::new(Location::File, problem)
}
