//! Skeletons of neurons.

use crate::arrays::array_of_rows;
use crate::errors::Raise;
use crate::hausdorff::limits;
use crate::json::written;
use crate::wait::{self, Share, Watch};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::neuron::{
    MeshError, MeshOptions, NeuronMesh, Preparation, Skeleton, SmoothOptions, SwcError, SwcRow,
    TransportOptions, mesh_neuron, prepare, read_transport_config, transport, write_swc,
};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A skeleton that was read.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronSkeleton(Skeleton);

/// A skeleton: itself, numbers, kinds, places, radii, parents (−1 for a root), the file it would be, and what is said of it.
type Parts<'py> = (
    NeuronSkeleton,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<i64>>,
    String,
    String,
);

/// Reads a skeleton from the bytes of an SWC file.
#[pyfunction]
pub(crate) fn read_skeleton<'py>(
    py: Python<'py>,
    bytes: &[u8],
    repair: bool,
    steps: usize,
    spacing: Option<f64>,
) -> PyResult<Parts<'py>> {
    let (skeleton, report) = py
        .detach(|| prepare(bytes, &Preparation { repair, smooth: SmoothOptions { steps, spacing } }))
        .map_err(|error: SwcError| error.raise())?;
    let rows = skeleton.rows();
    let column = |of: fn(&SwcRow) -> i64| rows.iter().map(of).collect::<Vec<_>>().into_pyarray(py);
    let ids = skeleton.samples().iter().map(|sample| sample.id).collect::<Vec<_>>();
    let positions = array_of_rows(py, rows.iter().map(|row| row.position).collect())?;
    Ok((
        NeuronSkeleton(skeleton),
        ids.into_pyarray(py),
        column(|row| row.kind),
        positions,
        rows.iter().map(|row| row.radius).collect::<Vec<_>>().into_pyarray(py),
        column(|row| row.parent.map_or(-1, |parent| parent - 1)),
        write_swc(&rows),
        written(&report)?,
    ))
}

/// How to mesh a neuron, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Meshing {
    parts: usize,
    layer: f64,
    threads: Option<usize>,
    time_limit: Option<f64>,
    memory_limit: Option<usize>,
}

impl Meshing {
    fn options(self) -> PyResult<MeshOptions<'static>> {
        Ok(MeshOptions {
            parts: self.parts,
            layer: self.layer,
            limits: limits(self.threads, self.time_limit, self.memory_limit)?,
            ..MeshOptions::default()
        })
    }
}

/// A mesh that was made.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronHexahedra(NeuronMesh);

/// A mesh: itself, places, cells, the branch of each cell, faces of the boundary, their caps (−1 on the wall), samples of caps, the file it
/// would be, and what is said of it.
type MeshParts<'py> = (
    NeuronHexahedra,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyBytes>,
    String,
);

#[pymethods]
impl NeuronSkeleton {
    /// Fills the neuron with hexahedra.
    fn mesh<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<MeshParts<'py>> {
        let options = meshing.options()?;
        let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
            let found = mesh_neuron(&self.0, &MeshOptions { progress: Some(&*watch), ..options })?;
            let file = found.vtu().map_err(|_| MeshError::Stopped)?;
            Ok::<_, MeshError>((found, file))
        })?;
        let (found, file) = found.map_err(Raise::raise)?;
        let caps = found.labels.iter().map(|&label| label.cast_signed() - 1).collect::<Vec<_>>();
        let branches = found.parts.clone().into_pyarray(py);
        let positions = found.mesh.positions().iter().copied().map(<[f64; 3]>::from).collect();
        let cells = array_of_rows(py, found.mesh.cells().to_vec())?;
        let boundary = found.faces.boundary().iter().map(|face| face.vertices).collect();
        let samples = found.caps.iter().map(|cap| cap.sample).collect::<Vec<_>>().into_pyarray(py);
        let report = written(&found.report)?;
        Ok((
            NeuronHexahedra(found),
            array_of_rows(py, positions)?,
            cells,
            branches,
            array_of_rows(py, boundary)?,
            caps.into_pyarray(py),
            samples,
            PyBytes::new(py, &file),
            report,
        ))
    }
}

/// What became of material: concentrations at the flat ends after each step, one row for each end and step; steps, times and
/// concentrations of frames; how many seconds a step takes; what is said of it.
type TransportParts<'py> = (Bound<'py, PyArray2<f64>>, Vec<usize>, Bound<'py, PyArray2<f64>>, f64, String);

#[pymethods]
impl NeuronHexahedra {
    /// Lets material diffuse and be carried through the mesh.
    fn transport<'py>(
        &self,
        py: Python<'py>,
        config: &str,
        frames: usize,
        time_limit: Option<f64>,
        memory_limit: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<TransportParts<'py>> {
        let parameters = read_transport_config(config).map_err(Raise::raise)?;
        let limits = limits(None, time_limit, memory_limit)?;
        let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
            let options = TransportOptions { limits, progress: Some(&*watch) };
            transport(&self.0, &parameters, frames, &options)
        })?;
        let found = found.map_err(Raise::raise)?;
        let ends = found.ends.into_iter().flatten().collect();
        let steps = found.frames.iter().map(|frame| frame.step).collect();
        let values = found.frames.into_iter().flat_map(|frame| frame.values).collect();
        Ok((
            array_of_rows(py, ends)?,
            steps,
            array_of_rows(py, values)?,
            parameters.step,
            written(&found.report)?,
        ))
    }
}
