//! Runs of material through cells of a neuron, and what they need: meshes, their options, checkpoints.

use crate::arrays::array_of_rows;
use crate::errors::Raise;
use crate::hausdorff::limits;
use crate::json::written;
use numpy::PyArray2;
use pompeiu::neuron::{
    Checkpoint, FlowCells, FlowReport, MeshOptions, MeshReport, NeuronMesh, NeuronPage, NeuronReport,
    NeuronRequestError, NeuronSurface, Parameters, RunIdentity, Transport, TransportState,
};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// How to mesh a neuron, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Meshing {
    parts: usize,
    layer: f64,
    within: Option<f64>,
    threads: Option<usize>,
    time_limit: Option<f64>,
    memory_limit: Option<usize>,
}

impl Meshing {
    /// Elements of patches, and how to mesh with tricubic cells.
    pub(crate) fn of_patches(self) -> PyResult<(usize, MeshOptions<'static>)> {
        Ok((self.parts, Self { parts: 1, ..self }.options()?))
    }

    pub(crate) fn options(self) -> PyResult<MeshOptions<'static>> {
        let default = MeshOptions::default();
        Ok(MeshOptions {
            parts: self.parts,
            layer: self.layer,
            within: self.within.unwrap_or(default.within),
            limits: limits(self.threads, self.time_limit, self.memory_limit)?,
            ..default
        })
    }
}

/// A mesh that was made.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronHexahedra(pub(crate) NeuronMesh);

/// What became of material: the run, concentrations at the flat ends after each step, one row for each end and step; steps, times and
/// concentrations of frames; how many seconds a step takes; what is said of it.
pub(crate) type TransportParts<'py> =
    (NeuronRun, Bound<'py, PyArray2<f64>>, Vec<usize>, Bound<'py, PyArray2<f64>>, f64, String);

/// What pages and checkpoints need of a run.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronRun {
    state: TransportState,
    inlet: u32,
    parameters: Parameters,
    cells: RunCells,
    report: NeuronReport,
    identity: RunIdentity,
}

/// What a checkpoint belongs to: the bytes of a file and the options that make cells of it; and the checkpoint to go on from, with its name.
#[derive(FromPyObject)]
pub(crate) struct Origin(Vec<u8>, String, Option<(std::path::PathBuf, Vec<u8>)>);

impl Origin {
    /// The identity of a run with these parameters, and the state to go on from.
    pub(crate) fn resumed(self, parameters: &Parameters) -> PyResult<(RunIdentity, Option<TransportState>)> {
        let Self(content, options, checkpoint) = self;
        let identity = RunIdentity::new(&content, &options, parameters);
        let Some((path, bytes)) = checkpoint else { return Ok((identity, None)) };
        let read = Checkpoint::from_bytes(&bytes, &identity);
        let read = read.map_err(|error| NeuronRequestError::Checkpoint { path, error }.raise())?;
        Ok((identity, Some(read.state)))
    }
}

/// The cells of a run.
pub(crate) enum RunCells {
    Mesh(Py<NeuronHexahedra>),
    Flow(Box<FlowCells>),
}

#[pymethods]
impl NeuronRun {
    /// The state after the last step, from which another run goes on, as the bytes of a checkpoint.
    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = Checkpoint::new(&self.identity, self.state.clone()).to_bytes();
        Ok(PyBytes::new(py, &bytes.map_err(Raise::raise)?))
    }

    /// A page that plays the transport.
    fn html(&self, py: Python<'_>, name: &str) -> PyResult<String> {
        let (surface, caps) = match &self.cells {
            RunCells::Mesh(mesh) => (NeuronSurface::new(&mesh.get().0), mesh.get().0.caps.as_slice()),
            RunCells::Flow(cells) => (NeuronSurface::of_flow(cells), cells.caps()),
        };
        let (inlet, parameters, state, report) = (self.inlet, &self.parameters, &self.state, &self.report);
        let page = NeuronPage {
            path: name,
            surface: &surface,
            caps,
            inlet,
            parameters,
            state,
            report,
            command: None,
        };
        py.detach(|| page.html()).map_err(Raise::raise)
    }
}

/// What became of material, as the Python half takes it.
pub(crate) fn transport_parts(
    py: Python<'_>,
    found: Transport,
    parameters: Parameters,
    cells: RunCells,
    identity: RunIdentity,
    (mesh, flow): (Option<MeshReport>, Option<FlowReport>),
) -> PyResult<TransportParts<'_>> {
    let state = found.state;
    let steps = state.frames.iter().map(|frame| frame.step).collect();
    let values = state.frames.iter().flat_map(|frame| frame.values.iter().copied()).collect();
    let ends = array_of_rows(py, state.ends.iter().flatten().copied().collect())?;
    let (step, said) = (parameters.step, written(&found.report)?);
    let report = NeuronReport { mesh, flow, transport: Some(found.report), ..NeuronReport::default() };
    let run = NeuronRun { state, inlet: found.inlet, parameters, cells, report, identity };
    Ok((run, ends, steps, array_of_rows(py, values)?, step, said))
}
