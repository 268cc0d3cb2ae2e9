//! What JSON answers have in common. Doubles are written as the shortest decimals that read back to them.

use crate::pair::File;
use pompeiu::hausdorff::{Direction, Enclosure, SurfacePoint, Witness};
use serde::Serialize;
use std::time::Duration;

#[derive(Serialize)]
pub(crate) struct MeshFile<'o> {
    path: &'o str,
    vertices: usize,
    faces: usize,
}

impl<'o> From<&'o File> for MeshFile<'o> {
    fn from(file: &'o File) -> Self {
        Self { path: &file.path, vertices: file.vertices, faces: file.faces }
    }
}

/// `a` lies on mesh A and `b` on mesh B, whatever the direction.
#[derive(Serialize)]
pub(crate) struct WitnessPoints {
    a: Point,
    b: Point,
}

#[derive(Serialize)]
pub(crate) struct Point {
    face: u32,
    barycentric: [f64; 3],
    position: [f64; 3],
}

impl From<SurfacePoint> for Point {
    fn from(point: SurfacePoint) -> Self {
        Self { face: point.face.0, barycentric: point.barycentric, position: point.position }
    }
}

impl WitnessPoints {
    pub(crate) fn new(witness: &Witness, direction: Direction) -> Self {
        let (from, to) = (witness.from.into(), witness.to.into());
        match direction {
            Direction::AToB => Self { a: from, b: to },
            Direction::BToA => Self { a: to, b: from },
        }
    }
}

#[derive(Serialize)]
pub(crate) struct Bounds {
    lower: f64,
    upper: f64,
}

impl From<Enclosure> for Bounds {
    fn from(enclosure: Enclosure) -> Self {
        Self { lower: enclosure.lower(), upper: enclosure.upper() }
    }
}

pub(crate) fn milliseconds(span: Duration) -> f64 {
    span.as_nanos() as f64 / 1e6
}
