//! Straightening cuts.

use crate::arrays::{array_of, array_of_rows};
use crate::errors::Raise;
use crate::mesh::Mesh;
use crate::wait;
use numpy::{PyArray1, PyArray2};
use pompeiu::core::VertexId;
use pompeiu::flatten::{CutError, FlattenError};
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// The surface that a mesh is.
fn surface_of(mesh: &Bound<'_, Mesh>) -> PyResult<EmbeddedSurface> {
    let held = mesh.clone().unbind();
    let made = wait::abandonable(mesh.py(), move || EmbeddedSurface::new(held.get().inner()))?;
    made.map_err(Raise::raise)
}

/// A straightened cut: the mesh that it was inserted into, its edges, and the face of the input that each face is a part of.
type Straight<'py> = (Mesh, Bound<'py, PyArray2<u32>>, Bound<'py, PyArray1<u32>>);

/// Straightens a cut and inserts it into the mesh.
#[pyfunction]
pub(crate) fn straighten<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    edges: Vec<[u32; 2]>,
) -> PyResult<Straight<'py>> {
    let surface = surface_of(mesh)?;
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let ends = |edge| sorted(surface.mesh().ends(edge).map(|v| v.0));
    let by_ends: BTreeMap<[u32; 2], _> = surface.mesh().edge_ids().map(|edge| (ends(edge), edge)).collect();
    let mut cut = EdgeData::filled(surface.mesh().edges(), false);
    for ends in edges {
        let missing = || CutError::NoEdge { ends: ends.map(VertexId) };
        let edge = by_ends.get(&sorted(ends)).ok_or_else(missing);
        cut[*edge.map_err(|error| FlattenError::from(error).raise())?] = true;
    }
    let straight = wait::abandonable(py, move || pompeiu::flatten::straighten(&surface, &cut))?;
    let straight = straight.map_err(|error| FlattenError::from(error).raise())?;
    let of = straight.surface.mesh();
    let edges: Vec<[u32; 2]> =
        of.edge_ids().filter(|&edge| straight.cut[edge]).map(|edge| of.ends(edge).map(|v| v.0)).collect();
    let faces: Vec<u32> = straight.faces.iter().map(|face| face.0).collect();
    Ok((Mesh::from(straight.mesh), array_of_rows(py, edges)?, array_of(py, faces)?))
}
