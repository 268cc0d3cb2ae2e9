//! Shapes with known answers.

use crate::errors::Raise;
use crate::mesh::Mesh;
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::shapes::{self, Diagonal, Ends, ShapeError};
use pyo3::prelude::*;

fn made(shape: Result<TriMesh, ShapeError>) -> PyResult<Mesh> {
    shape.map(Mesh::from).map_err(Raise::raise)
}

/// Cube around the origin, each side of `cells` by `cells` squares of two faces.
#[pyfunction]
#[pyo3(signature = (side=1.0, cells=1))]
pub(crate) fn cube(py: Python<'_>, side: f64, cells: u32) -> PyResult<Mesh> {
    made(py.detach(|| shapes::cube(side, cells)))
}

/// Cylinder around the z axis: a prism over a regular polygon, open unless `capped`.
#[pyfunction]
#[pyo3(signature = (radius=1.0, height=2.0, segments=32, rows=1, capped=false))]
pub(crate) fn cylinder(
    py: Python<'_>,
    radius: f64,
    height: f64,
    segments: u32,
    rows: u32,
    capped: bool,
) -> PyResult<Mesh> {
    let ends = if capped { Ends::Capped } else { Ends::Open };
    made(py.detach(|| shapes::cylinder(radius, height, segments, rows, ends)))
}

/// Rectangle in the plane z = 0 around the origin: sides `size`, each of the `cells` rectangles split into two faces.
#[pyfunction]
#[pyo3(signature = (size=(1.0, 1.0), cells=(1, 1)))]
pub(crate) fn grid(py: Python<'_>, size: (f64, f64), cells: (u32, u32)) -> PyResult<Mesh> {
    made(py.detach(|| shapes::grid(size.into(), cells.into(), Diagonal::Rising)))
}

/// Sphere around the origin: an icosahedron whose faces are divided in four `subdivisions` times.
#[pyfunction]
#[pyo3(signature = (radius=1.0, subdivisions=3))]
pub(crate) fn icosphere(py: Python<'_>, radius: f64, subdivisions: u32) -> PyResult<Mesh> {
    made(py.detach(|| shapes::icosphere(radius, subdivisions)))
}

/// Schwarz's lantern: triangles with their corners on a cylinder, every other circle turned by half a step.
#[pyfunction]
#[pyo3(signature = (radius=1.0, height=2.0, segments=16, bands=16))]
pub(crate) fn schwarz_lantern(
    py: Python<'_>,
    radius: f64,
    height: f64,
    segments: u32,
    bands: u32,
) -> PyResult<Mesh> {
    made(py.detach(|| shapes::schwarz_lantern(radius, height, segments, bands)))
}

/// Torus around the z axis.
#[pyfunction]
#[pyo3(signature = (major_radius=2.0, minor_radius=0.7, major_segments=48, minor_segments=24))]
pub(crate) fn torus(
    py: Python<'_>,
    major_radius: f64,
    minor_radius: f64,
    major_segments: u32,
    minor_segments: u32,
) -> PyResult<Mesh> {
    made(py.detach(|| shapes::torus(major_radius, minor_radius, major_segments, minor_segments)))
}
