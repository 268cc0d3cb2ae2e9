//! Repairing meshes.

use crate::errors::Raise;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Watch};
use pompeiu::core::mesh::repair::{RepairOptions, Weld, repair as repaired_mesh};
use pompeiu::hausdorff::{HausdorffOptions, Progress};
use pyo3::prelude::*;

/// Options of a repair.
#[derive(Clone, Copy, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct RepairChoice {
    /// 0 for equal positions.
    weld: Option<f64>,
    fill_holes: usize,
    /// Whether to measure how far the result is from the mesh.
    measure: bool,
}

/// Makes a mesh an oriented manifold: the result, what was done, and its distance from the mesh.
#[pyfunction]
pub(crate) fn repair(
    py: Python<'_>,
    mesh: &Bound<'_, Mesh>,
    options: RepairChoice,
) -> PyResult<(Mesh, String, Option<String>)> {
    let weld = match options.weld {
        None => Weld::Never,
        Some(0.0) => Weld::Equal,
        Some(length) => Weld::Within(length),
    };
    let mesh = mesh.clone().unbind();
    let (repaired, distance) = wait::run_detached(py, None, move |watch: &mut Watch<'_, Progress>| {
        let mesh = mesh.get().inner();
        let repaired = repaired_mesh(
            mesh,
            &RepairOptions { weld, fill_holes: options.fill_holes, ..RepairOptions::default() },
        )
        .map_err(Raise::raise)?;
        let asked = HausdorffOptions { observer: Some(&*watch), ..HausdorffOptions::default() };
        let distance = options.measure.then(|| asked.symmetric(mesh, &repaired.mesh)).transpose();
        Ok::<_, PyErr>((repaired, distance.map_err(Raise::raise)?))
    })??;
    let distance = distance.as_ref().map(written).transpose()?;
    let report = written(&repaired.report)?;
    Ok((Mesh::from(repaired.mesh), report, distance))
}
