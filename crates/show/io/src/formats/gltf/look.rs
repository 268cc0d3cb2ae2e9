//! How the triangles of a scene look.

use super::accessor;
use super::buffers::Buffers;
use super::document::{Document, Primitive, entry, wrong};
use super::numbers::VERTEX_NUMBERS;
use super::transform::Transform;
use crate::appearance::{Appearance, CornerValues, Descriptions, Materials, channel, srgb_from_linear};
use crate::error::FormatError;
use pompeiu_core::TriMesh;
use std::collections::{BTreeSet, HashSet};

/// Sets of texture coordinates that are read; programs use one or two.
const MOST_SETS: usize = 8;

/// Values of the vertices, one after the other as the scene shows them, and what is known of each face.
#[derive(Default)]
pub(super) struct Look {
    normals: Vec<[f64; 3]>,
    lacks_normals: bool,
    has_normals: bool,
    colors: Vec<[f64; 4]>,
    has_colors: bool,
    /// Each at most as long as there are vertices.
    sets: Vec<Vec<[f64; 2]>>,
    /// Vertices of the faces.
    corners: Vec<[u32; 3]>,
    /// 0, or one more than the material.
    materials: Vec<u32>,
    names: Vec<String>,
    left_out: BTreeSet<&'static str>,
}

impl Look {
    pub(super) fn of(document: &Document) -> Self {
        let parts = [
            (!document.animations.is_empty(), "animations"),
            (!document.skins.is_empty(), "skins"),
            (!document.cameras.is_empty(), "cameras"),
            (document.extensions.contains_key("KHR_lights_punctual"), "lights"),
            (document.extensions.contains_key("KHR_materials_variants"), "variants of materials"),
            (document.nodes.iter().filter(|node| node.mesh.is_some()).count() > 1, "separate nodes"),
        ];
        let left_out = parts.into_iter().filter(|(has, _)| *has).map(|(_, name)| name).collect();
        Self { names: names(document), left_out, ..Self::default() }
    }

    /// The number of vertices so far.
    pub(super) fn vertices(&self) -> usize {
        self.normals.len()
    }

    /// The bytes that vertices of a primitive take.
    pub(super) fn bytes(&self, primitive: &Primitive, vertices: usize) -> u64 {
        let sets = texture_sets(primitive).count().max(self.sets.len());
        (vertices * (size_of::<[f64; 3]>() + size_of::<[f64; 4]>() + sets * size_of::<[f64; 2]>())) as u64
    }

    /// Adds the values of the vertices of a primitive.
    pub(super) fn add_vertices(
        &mut self,
        document: &Document,
        buffers: &Buffers<'_>,
        primitive: &Primitive,
        transform: &Transform,
        vertices: usize,
    ) -> Result<(), FormatError> {
        let before = self.vertices();
        let attributes = &primitive.attributes;
        if let Some(index) = attributes.of("NORMAL") {
            let normals = values::<3>(document, buffers, index, vertices)?;
            self.normals.extend(normals.into_iter().map(|normal| transform.apply_to_normal(normal)));
        }
        self.normals.resize(before + vertices, [0.0; 3]);
        if let Some(index) = attributes.of("COLOR_0") {
            self.has_colors = true;
            self.colors.extend(values::<4>(document, buffers, index, vertices)?);
        }
        // Colours are factors, so that none is white.
        self.colors.resize(before + vertices, [1.0; 4]);
        for (set, index) in texture_sets(primitive).enumerate() {
            if set == self.sets.len() {
                self.sets.push(Vec::new());
            }
            self.sets[set].resize(before, [0.0; 2]);
            // glTF counts from the upper left corner of the image.
            let places = values::<2>(document, buffers, index, vertices)?;
            self.sets[set].extend(places.into_iter().map(|[u, v]| [u, 1.0 - v]));
        }
        self.note_left_out(primitive);
        Ok(())
    }

    fn note_left_out(&mut self, primitive: &Primitive) {
        let attributes = &primitive.attributes;
        let beyond = format!("TEXCOORD_{MOST_SETS}");
        for (has, name) in [
            (attributes.of("TANGENT").is_some(), "tangents"),
            (attributes.of("COLOR_1").is_some(), "further colours"),
            (attributes.of(&beyond).is_some(), "texture coordinates beyond eight sets"),
            (attributes.0.keys().any(is_foreign), "attributes of other programs"),
            (!primitive.targets.is_empty(), "morph targets"),
        ] {
            if has {
                self.left_out.insert(name);
            }
        }
    }

    /// Adds a face with these vertices.
    pub(super) fn add_face(&mut self, corners: [u32; 3], primitive: &Primitive) {
        let has_normals = primitive.attributes.of("NORMAL").is_some();
        self.has_normals |= has_normals;
        self.lacks_normals |= !has_normals;
        self.corners.push(corners);
        let material = primitive.material.filter(|material| *material < self.names.len());
        self.materials.push(material.map_or(0, |material| material as u32 + 1));
    }

    /// The appearance of the mesh.
    pub(super) fn finish(mut self, mesh: &TriMesh, descriptions: Descriptions) -> Appearance {
        if self.has_normals && self.lacks_normals {
            self.left_out.insert("normals, which some faces lack");
        }
        let vertices = self.vertices();
        let corners = self.corners;
        let colors = self.has_colors.then(|| {
            let mut colors = vec![[255; 3]; mesh.positions().len()];
            for (v, shown) in mesh.faces().as_flattened().iter().zip(corners.as_flattened()) {
                let [red, green, blue, _] = self.colors[*shown as usize];
                colors[*v as usize] = [red, green, blue].map(|x| channel(srgb_from_linear(x)));
            }
            colors
        });
        let linear_colors =
            self.has_colors.then(|| CornerValues { values: self.colors, corners: corners.clone() });
        let texture = self.sets.into_iter().map(|mut values| {
            values.resize(vertices, [0.0; 2]);
            CornerValues { values, corners: corners.clone() }
        });
        let texture = texture.collect();
        let materials = self.materials.iter().any(|material| *material > 0).then(|| {
            let names = std::iter::once(String::new()).chain(self.names).collect();
            Materials { library: None, names, faces: self.materials, descriptions: Some(descriptions) }
        });
        let normals = (self.has_normals && !self.lacks_normals)
            .then_some(CornerValues { values: self.normals, corners });
        let left_out = self.left_out.into_iter().map(str::to_owned).collect();
        Appearance { colors, linear_colors, texture, normals, materials, left_out }
    }
}

/// Whether an attribute is one that another program has defined.
fn is_foreign(name: &String) -> bool {
    name.starts_with('_') && name != VERTEX_NUMBERS
}

/// The accessors of the sets of texture coordinates of a primitive.
fn texture_sets(primitive: &Primitive) -> impl Iterator<Item = usize> {
    (0..MOST_SETS).map_while(|set| primitive.attributes.of(&format!("TEXCOORD_{set}")))
}

fn values<const N: usize>(
    document: &Document,
    buffers: &Buffers<'_>,
    index: usize,
    vertices: usize,
) -> Result<Vec<[f64; N]>, FormatError> {
    let accessor = entry(&document.accessors, "accessor", index)?;
    if accessor.count != vertices as u64 {
        let problem = format!("accessor {index} has {} values for {vertices} vertices", accessor.count);
        return Err(wrong(problem));
    }
    accessor::vectors(buffers, accessor, index)
}

/// The names of the materials, made different from each other.
fn names(document: &Document) -> Vec<String> {
    let mut used = HashSet::new();
    let own =
        |material: &serde_json::Value| material.get("name").and_then(|name| name.as_str()).map(str::to_owned);
    let named = document.materials.iter().enumerate().map(|(index, material)| {
        let name = own(material).filter(|name| !name.trim().is_empty());
        let mut name = name.unwrap_or_else(|| format!("material-{index}"));
        while !used.insert(name.clone()) {
            name = format!("{name}-{index}");
        }
        name
    });
    named.collect()
}
