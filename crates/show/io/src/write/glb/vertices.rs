//! The vertices as they are written: one for each combination of values that the corners of a vertex have.

use super::super::{Attributes, normals};
use crate::appearance::{CornerValues, linear_from_srgb};
use pompeiu_core::TriMesh;
use std::collections::HashMap;

/// Squares of lengths of normals may differ by this much from 1 before they are divided by their length.
const UNIT_TOLERANCE: f64 = 1e-4;

/// The written vertices. Those of the mesh come first, in their order, then further ones with other values.
pub(super) struct Written {
    /// For each the vertex of the mesh.
    pub(super) vertices: Vec<u32>,
    /// The faces by written vertices.
    pub(super) faces: Vec<[u32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// Linear colours and opacity.
    pub(super) colors: Option<Vec<[u16; 4]>>,
    /// The sets of texture coordinates, from the upper left corner of the image.
    pub(super) texture: Vec<Vec<[f32; 2]>>,
}

impl Written {
    pub(super) fn of(mesh: &TriMesh, attributes: &Attributes) -> Self {
        let computed =
            if attributes.normals().is_none() { normals::smooth(mesh) } else { CornerValues::default() };
        let normals = attributes.normals().unwrap_or(&computed);
        let linear = attributes.linear_colors();
        let sets = attributes.texture();
        let lists: Vec<&[[u32; 3]]> = std::iter::once(&normals.corners[..])
            .chain(linear.map(|colors| &colors.corners[..]))
            .chain(sets.iter().map(|set| &set.corners[..]))
            .collect();
        let split = Split::of(mesh, &lists);
        let value = |list: usize, w: usize| split.values[w * lists.len() + list];
        let count = split.vertices.len();
        let is_used = |w: &usize| value(0, *w) != UNUSED;
        let normal_of = |w: usize| {
            if is_used(&w) { written_normal(normals.values[value(0, w) as usize]) } else { [0.0, 0.0, 1.0] }
        };
        let colors = match (linear, attributes.vertex_colors()) {
            (Some(colors), _) => Some(
                (0..count)
                    .map(|w| {
                        if is_used(&w) {
                            channels(colors.values[value(1, w) as usize])
                        } else {
                            [u16::MAX; 4]
                        }
                    })
                    .collect(),
            ),
            (None, Some(colors)) => {
                let linear: [u16; 256] =
                    std::array::from_fn(|encoded| share(linear_from_srgb(encoded as f64 / 255.0)));
                let of = |v: &u32| {
                    let [red, green, blue] = colors[*v as usize].map(|channel| linear[channel as usize]);
                    [red, green, blue, u16::MAX]
                };
                Some(split.vertices.iter().map(of).collect())
            }
            (None, None) => None,
        };
        let first_set = 1 + usize::from(linear.is_some());
        let places = |(i, set): (usize, &CornerValues<2>)| {
            let of = |w: usize| {
                if !is_used(&w) {
                    return [0.0; 2];
                }
                let [u, v] = set.values[value(first_set + i, w) as usize];
                [u as f32, (1.0 - v) as f32]
            };
            (0..count).map(of).collect()
        };
        let texture = sets.iter().enumerate().map(places).collect();
        let normals = (0..count).map(normal_of).collect();
        Self { vertices: split.vertices, faces: split.faces, normals, colors, texture }
    }
}

/// A vertex that no face has.
const UNUSED: u32 = u32::MAX;

/// Vertices split where the corners have other indices.
struct Split {
    vertices: Vec<u32>,
    faces: Vec<[u32; 3]>,
    /// For each written vertex the index in each list.
    values: Vec<u32>,
}

impl Split {
    fn of(mesh: &TriMesh, lists: &[&[[u32; 3]]]) -> Self {
        let number = mesh.positions().len();
        let width = lists.len();
        let mut split = Self {
            vertices: (0..number as u32).collect(),
            faces: mesh.faces().to_vec(),
            values: vec![UNUSED; number * width],
        };
        // Vertices beyond the first of each.
        let mut further: HashMap<(u32, Vec<u32>), u32> = HashMap::new();
        let mut indices = vec![0; width];
        for f in 0..split.faces.len() {
            for i in 0..3 {
                let v = split.faces[f][i];
                indices.iter_mut().zip(lists).for_each(|(index, list)| *index = list[f][i]);
                let own = &mut split.values[v as usize * width..(v as usize + 1) * width];
                if own[0] == UNUSED {
                    own.copy_from_slice(&indices);
                }
                if *own == indices[..] {
                    continue;
                }
                let next = split.vertices.len() as u32;
                split.faces[f][i] = *further.entry((v, indices.clone())).or_insert(next);
                if split.faces[f][i] == next {
                    split.vertices.push(v);
                    split.values.extend_from_slice(&indices);
                }
            }
        }
        split
    }
}

fn written_normal(normal: [f64; 3]) -> [f32; 3] {
    let [x, y, z] = normal;
    let is_unit = (x * x + y * y + z * z - 1.0).abs() <= UNIT_TOLERANCE;
    let normal = if is_unit { normal } else { normals::unit(normal).unwrap_or([0.0, 0.0, 1.0]) };
    normal.map(|x| x as f32)
}

fn channels(color: [f64; 4]) -> [u16; 4] {
    color.map(share)
}

/// Sixteen bits for a share; values out of range are clamped, and so is NaN. They keep all 256 values of sRGB distinct; eight would merge
/// the dark ones.
fn share(value: f64) -> u16 {
    (value * f64::from(u16::MAX)).round() as u16
}
