//! Numbers and vectors on meshes.

use serde::Serialize;

/// Numbers or vectors on a mesh: for each corner of each triangle, each vertex or each face.
///
/// Values are interpolated linearly between corners or vertices. Vectors are coloured by length.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshValues {
    pub(super) on: Element,
    pub(super) width: usize,
    pub(super) numbers: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) enum Element {
    Corner,
    Vertex,
    Face,
}

impl MeshValues {
    /// A number for each corner of each triangle.
    pub fn on_corners(values: Vec<[f64; 3]>) -> Self {
        Self { on: Element::Corner, width: 1, numbers: values.into_flattened() }
    }

    /// A number for each vertex.
    pub fn on_vertices(values: Vec<f64>) -> Self {
        Self { on: Element::Vertex, width: 1, numbers: values }
    }

    /// A number for each face.
    pub fn on_faces(values: Vec<f64>) -> Self {
        Self { on: Element::Face, width: 1, numbers: values }
    }

    /// A vector for each corner of each triangle.
    pub fn vectors_on_corners(vectors: Vec<[[f64; 3]; 3]>) -> Self {
        let numbers = vectors.into_flattened().into_flattened();
        Self { on: Element::Corner, width: 3, numbers }
    }

    /// A vector for each vertex.
    pub fn vectors_on_vertices(vectors: Vec<[f64; 3]>) -> Self {
        Self { on: Element::Vertex, width: 3, numbers: vectors.into_flattened() }
    }

    /// A vector for each face.
    pub fn vectors_on_faces(vectors: Vec<[f64; 3]>) -> Self {
        Self { on: Element::Face, width: 3, numbers: vectors.into_flattened() }
    }

    /// 1 for numbers, 3 for vectors.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// A component of the value of an element.
    pub(super) fn at(&self, element: usize, component: usize) -> f64 {
        self.numbers[self.width * element + component]
    }

    /// The greatest absolute value or length.
    pub(super) fn largest(&self) -> f64 {
        let size = |value: &[f64]| match value {
            [x] => x.abs(),
            _ => value.iter().fold(0.0, |size: f64, x| size.hypot(*x)),
        };
        self.numbers.chunks_exact(self.width).map(size).fold(0.0, |a, b| if b > a { b } else { a })
    }
}
