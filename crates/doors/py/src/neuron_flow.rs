//! Tricubic cells of neurons, and flow through them.

use crate::arrays::{array_of, array_of_rows};
use crate::errors::Raise;
use crate::hausdorff::limits;
use crate::json::written;
use crate::neuron_run::{Meshing, Origin, RunCells, TransportParts, transport_parts};
use crate::wait::{self, Share, Watch};
use numpy::{PyArray1, PyArray2};
use pompeiu::neuron::{
    CubicMesh, Flow, FlowCells, FlowOptions, FlowParameters, MeshError, MeshOptions, MeshReport, NeuronMesh,
    RefineAt, RefineOptions, Skeleton, SplineReport, TransportError, TransportOptions, cubic_neuron,
    neuron_flow, read_transport_config, refined_splines, refined_vtu, transport_in_flow,
};
use pompeiu::volume::{HierarchicalElement, HierarchicalSplines};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A flow that was solved for.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronFlow {
    flow: Flow,
    mesh: MeshReport,
    parameters: FlowParameters,
}

/// Splines over a mesh of tricubic cells.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronSplineSpace(CubicMesh, HierarchicalSplines);

#[pymethods]
impl NeuronSplineSpace {
    /// For each element where its functions begin, and where the last end; all of these functions; their Bézier coefficients.
    fn extraction<'py>(&self, py: Python<'py>) -> PyResult<ExtractionParts<'py>> {
        let cells = py.detach(|| self.1.extraction());
        let (mut starts, mut functions, mut coefficients) = (vec![0], Vec::new(), Vec::new());
        for cell in cells.cells() {
            functions.extend(cell.functions.iter().map(|&function| i64::from(function)));
            coefficients.extend_from_slice(&cell.coefficients);
            starts.push((functions.len() as u64).cast_signed());
        }
        Ok((array_of(py, starts)?, array_of(py, functions)?, array_of_rows(py, coefficients)?))
    }

    /// The coefficients of positions.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_rows(py, places(&py.detach(|| self.1.represent(&self.0.mesh, self.0.mesh.points()))))
    }
}

/// See [`NeuronSplineSpace::extraction`].
type ExtractionParts<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray2<f64>>);

/// A mesh of tricubic cells and splines over it: those, places of control points, cells, branches, elements (level, patch, place), the file
/// it would be, and what is said of it and of its splines.
pub(crate) type SplineParts<'py> = (
    NeuronSplineSpace,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyBytes>,
    String,
    String,
);

/// A flow: itself, places of control points, cells, branches, velocities at control points, pressures of cells; samples of the flat ends,
/// what flows out there and the pressure; the file it would be, and what is said of the mesh and of the flow.
pub(crate) type FlowParts<'py> = (
    NeuronFlow,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyBytes>,
    String,
    String,
);

fn places<P: Copy + Into<[f64; 3]>>(points: &[P]) -> Vec<[f64; 3]> {
    points.iter().copied().map(Into::into).collect()
}

/// What is filled with patches.
pub(crate) enum Source<'s> {
    /// One that was read, and what it was before smoothing.
    Skeleton(&'s Skeleton, Option<&'s Skeleton>),
    /// Each cell is a patch.
    Mesh(&'s NeuronMesh),
}

impl Source<'_> {
    fn skeleton(&self) -> Option<&Skeleton> {
        match self {
            Self::Skeleton(skeleton, _) => Some(skeleton),
            Self::Mesh(_) => None,
        }
    }

    fn patches(&self, options: &MeshOptions<'_>) -> Result<CubicMesh, MeshError> {
        match self {
            Self::Skeleton(skeleton, reference) => {
                cubic_neuron(skeleton, &MeshOptions { reference: *reference, ..options.clone() })
            }
            Self::Mesh(mesh) => CubicMesh::from_trilinear(mesh, &options.limits),
        }
    }
}

/// Fills the neuron with tricubic cells, each cut into this many spline elements along each edge, which are halved in some places.
#[expect(clippy::needless_pass_by_value, reason = "a name for one of two references")]
pub(crate) fn splines<'py>(
    py: Python<'py>,
    source: Source<'_>,
    meshing: Meshing,
    (at, times): (&[String], usize),
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<SplineParts<'py>> {
    let (elements, mut options) = meshing.of_patches()?;
    let at = at.iter().map(|name| RefineAt::from_name(name, source.skeleton()).map_err(Raise::raise));
    let at = at.collect::<PyResult<Vec<_>>>()?;
    let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
        options.limits.cancel = Some(watch.token());
        let limits = options.limits.clone();
        let found = source.patches(&MeshOptions { progress: Some(&*watch), ..options })?;
        let times = if at.is_empty() { 0 } else { times };
        let options = RefineOptions { elements, at: &at, times, limits, progress: Some(&*watch) };
        let splines = refined_splines(&found, &options)?;
        let (file, report) = if at.is_empty() {
            (found.vtu(true), SplineReport::new(&found.mesh, elements))
        } else {
            (refined_vtu(&found, &splines, true), SplineReport::of_refined(&splines))
        };
        Ok::<_, MeshError>((found, splines, file, report))
    })?;
    let (found, splines, file, report) = found.map_err(Raise::raise)?;
    spline_parts(py, found, splines, &file?, &report)
}

/// Splines as the Python half takes them.
pub(crate) fn spline_parts<'py>(
    py: Python<'py>,
    found: CubicMesh,
    splines: HierarchicalSplines,
    file: &[u8],
    report: &SplineReport,
) -> PyResult<SplineParts<'py>> {
    let row = |element: &HierarchicalElement| {
        let [i, j, k] = element.place.map(u32::from);
        [element.level.into(), element.patch, i, j, k]
    };
    let (mesh, spline) = (written(&found.report)?, written(report)?);
    let points = array_of_rows(py, places(found.mesh.points()))?;
    let cells = array_of_rows(py, found.mesh.cells().to_vec())?;
    let branches = array_of(py, found.parts.clone())?;
    let elements = array_of_rows(py, splines.elements().iter().map(row).collect())?;
    let file = PyBytes::new(py, file);
    Ok((NeuronSplineSpace(found, splines), points, cells, branches, elements, file, mesh, spline))
}

/// Fills the neuron with tricubic cells and solves for the flow through them.
#[expect(clippy::needless_pass_by_value, reason = "a name for one of two references")]
pub(crate) fn flow<'py>(
    py: Python<'py>,
    source: Source<'_>,
    meshing: Meshing,
    config: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<FlowParts<'py>> {
    let parameters = read_transport_config(config).map_err(Raise::raise)?.flow;
    let (elements, mut options) = meshing.of_patches()?;
    let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
        options.limits.cancel = Some(watch.token());
        let limits = options.limits.clone();
        let mesh = source.patches(&MeshOptions { progress: Some(&*watch), ..options })?;
        let options = FlowOptions { elements, limits, progress: Some(&*watch) };
        let flow = neuron_flow(&mesh, &parameters, &options);
        Ok::<_, MeshError>((mesh.report, flow))
    })?;
    let (mesh, flow) = found.map_err(Raise::raise)?;
    flow_parts(py, flow.map_err(Raise::raise)?, mesh, parameters)
}

/// A flow as the Python half takes it.
pub(crate) fn flow_parts(
    py: Python<'_>,
    flow: Flow,
    mesh: MeshReport,
    parameters: FlowParameters,
) -> PyResult<FlowParts<'_>> {
    let file = flow.vtu(true).map_err(PyErr::from)?;
    let ends = flow.ends.iter().map(|end| [end.flux, end.pressure]).collect();
    let samples = flow.ends.iter().map(|end| end.sample).collect::<Vec<_>>();
    let (said, report) = (written(&mesh)?, written(&flow.report)?);
    let points = array_of_rows(py, places(flow.mesh.points()))?;
    let cells = array_of_rows(py, flow.mesh.cells().to_vec())?;
    let branches = array_of(py, flow.parts.clone())?;
    let velocity = array_of_rows(py, places(&flow.velocity))?;
    let pressure = array_of(py, flow.pressure().to_vec())?;
    let (samples, ends) = (array_of(py, samples)?, array_of_rows(py, ends)?);
    let file = PyBytes::new(py, &file);
    let flow = NeuronFlow { flow, mesh, parameters };
    Ok((flow, points, cells, branches, velocity, pressure, samples, ends, file, said, report))
}

#[pymethods]
impl NeuronFlow {
    /// Lets material diffuse and be carried along the flow, through cells cut into this many parts along each edge.
    #[expect(clippy::too_many_arguments, reason = "one for each option of the Python half")]
    fn transport<'py>(
        &self,
        py: Python<'py>,
        parts: usize,
        config: &str,
        frames: usize,
        origin: Origin,
        time_limit: Option<f64>,
        memory_limit: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<TransportParts<'py>> {
        let parameters = read_transport_config(config).map_err(Raise::raise)?;
        let mut limits = limits(None, time_limit, memory_limit)?;
        let (identity, resume) = origin.resumed(&parameters)?;
        let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
            limits.cancel = Some(watch.token());
            let cells = FlowCells::new(&self.flow, parts, &limits)?;
            let options = TransportOptions { limits, progress: Some(&*watch), resume: resume.as_ref() };
            let found = transport_in_flow(&cells, &parameters, frames, &options)?;
            Ok::<_, TransportError>((cells, found))
        })?;
        let (cells, found) = found.map_err(Raise::raise)?;
        let reports = (Some(self.mesh.clone()), Some(self.flow.report.clone()));
        transport_parts(py, found, parameters, RunCells::Flow(Box::new(cells)), identity, reports)
    }

    /// The parameters of the flow in one line, where they are not those of a configuration: it is another flow then.
    fn other_than(&self, config: &str) -> PyResult<String> {
        let same = read_transport_config(config).map_err(Raise::raise)?.flow == self.parameters;
        Ok(if same { String::new() } else { format!(" {:?}", self.parameters) })
    }
}
