//! Appearance of a mesh in a file: colours, texture coordinates, normals, materials.

use serde_json::{Map, Value};

/// Colours, texture coordinates, normals and materials of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Appearance {
    /// The colours of the vertices: red, green and blue from 0 to 255, encoded as sRGB. Where the corners of a vertex have several, one
    /// of them.
    pub colors: Option<Vec<[u8; 3]>>,
    /// The colours as a glTF file has them: linear red, green and blue, and opacity, from 0 to 1.
    pub linear_colors: Option<CornerValues<4>>,
    /// The sets of texture coordinates, from the lower left corner of the image in units of its sides.
    pub texture: Vec<CornerValues<2>>,
    /// Normals for shading, of length 1.
    pub normals: Option<CornerValues<3>>,
    /// Materials of the faces.
    pub materials: Option<Materials>,
    /// What the file has besides, in the plural, such as `"animations"`.
    pub left_out: Vec<String>,
}

/// One value for each corner of each face. Where the corners of a vertex have several, there is a seam.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerValues<const N: usize> {
    /// The values.
    pub values: Vec<[f64; N]>,
    /// For each face the indices of its corners' values.
    pub corners: Vec<[u32; 3]>,
}

/// Names of materials, and which of them each face has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Materials {
    /// The file that describes them, as the mesh file names it.
    pub library: Option<String>,
    /// Their names, all different; the first is empty, for faces without a material.
    pub names: Vec<String>,
    /// The material of each face.
    pub faces: Vec<u32>,
    /// What they look like, as a glTF file has it.
    pub descriptions: Option<Descriptions>,
}

/// What the materials of a glTF file look like: its materials with their textures, samplers and images, kept as they are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Descriptions {
    /// The lists `materials`, `textures`, `samplers` and `images`, where they are not empty; images without their data.
    pub(crate) lists: Map<String, Value>,
    /// The data of each image; `None` where the image is named by an address.
    pub(crate) images: Vec<Option<Vec<u8>>>,
    /// Extensions that a reader must know.
    pub(crate) required: Vec<String>,
}

impl Descriptions {
    /// The number of images with data.
    pub fn image_count(&self) -> usize {
        self.images.iter().flatten().count()
    }

    /// Numbers the sets of texture coordinates anew: what used set `i` uses set `i + by`.
    pub fn shift_texture_sets(&mut self, by: usize) {
        if let Some(Value::Array(materials)) = self.lists.get_mut("materials") {
            for material in materials {
                shift_sets(material, by, DEPTH);
            }
        }
    }
}

/// Objects inside one another in the description of a material that are followed; the parser of documents allows 128.
const DEPTH: usize = 128;

/// Adds to the set of every reference to a texture, which is an object with an `index`.
fn shift_sets(value: &mut Value, by: usize, depth: usize) {
    let Some(deeper) = depth.checked_sub(1) else { return };
    match value {
        Value::Array(values) => values.iter_mut().for_each(|value| shift_sets(value, by, deeper)),
        Value::Object(entries) => {
            let set = entries.get("texCoord").map_or(Some(0), Value::as_u64);
            if let (Some(set), Some(Value::Number(_))) = (set, entries.get("index")) {
                entries.insert("texCoord".into(), set.saturating_add(by as u64).into());
            }
            // A transform may name a set of its own.
            if let Some(transform) = entries.get_mut("KHR_texture_transform")
                && let Some(set) = transform.get("texCoord").and_then(Value::as_u64)
            {
                transform["texCoord"] = set.saturating_add(by as u64).into();
            }
            entries.values_mut().for_each(|value| shift_sets(value, by, deeper));
        }
        _ => {}
    }
}

/// A colour channel from its share of the greatest value.
pub(crate) fn channel(share: f64) -> u8 {
    // Values out of range are clamped, and so is NaN.
    (255.0 * share).round() as u8
}

/// The share of the light of the greatest value that an sRGB channel stands for (IEC 61966-2-1).
pub(crate) fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The sRGB channel, from 0 to 1, of a share of light.
pub(crate) fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}
