//! Skeletons of neurons.

use crate::arrays::{array_of, array_of_rows};
use crate::errors::Raise;
use crate::hausdorff::limits;
use crate::json::written;
use crate::neuron_flow::{self, FlowParts, Source, SplineParts};
use crate::neuron_run::{Meshing, NeuronHexahedra, Origin, RunCells, TransportParts, transport_parts};
use crate::wait::{self, Share, Watch};
use numpy::{PyArray1, PyArray2};
use pompeiu::core::run::Limits;
use pompeiu::neuron::{
    Ends, MaterialCells, MeshError, MeshOptions, NeuronAnswer, NeuronMesh, NeuronRequest, NeuronRequestError,
    NeuronSource, Preparation, Side, Skeleton, SkeletonReport, SmoothOptions, SplineReport, SwcError, SwcRow,
    TransportOptions, Transported, WallDistance, mesh_neuron, meshability, prepare, read_transport_config,
    refined_vtu, transport, write_swc,
};
use pompeiu::volume::HexMesh;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// A skeleton that was read, and what it was before smoothing.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct NeuronSkeleton(Skeleton, Option<Skeleton>);

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
    let prepared = py
        .detach(|| prepare(bytes, &Preparation { repair, smooth: SmoothOptions { steps, spacing } }))
        .map_err(|error: SwcError| error.raise())?;
    skeleton_parts(py, prepared.skeleton, prepared.original, &prepared.report)
}

/// A skeleton as the Python half takes it.
fn skeleton_parts<'py>(
    py: Python<'py>,
    skeleton: Skeleton,
    original: Option<Skeleton>,
    report: &SkeletonReport,
) -> PyResult<Parts<'py>> {
    let rows = skeleton.rows();
    let column = |of: fn(&SwcRow) -> i64| array_of(py, rows.iter().map(of).collect());
    let ids = skeleton.samples().iter().map(|sample| sample.id).collect::<Vec<_>>();
    let positions = array_of_rows(py, rows.iter().map(|row| row.position).collect())?;
    Ok((
        NeuronSkeleton(skeleton, original),
        array_of(py, ids)?,
        column(|row| row.kind)?,
        positions,
        array_of(py, rows.iter().map(|row| row.radius).collect())?,
        column(|row| row.parent.map_or(-1, |parent| parent - 1))?,
        write_swc(&rows),
        written(report)?,
    ))
}

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

impl NeuronSkeleton {
    /// What is asked of the skeleton with options of a mesh, measured against the file.
    fn run<R: Send>(
        &self,
        py: Python<'_>,
        meshing: Meshing,
        progress: Option<&Bound<'_, PyAny>>,
        asked: impl FnOnce(&Skeleton, &MeshOptions<'_>) -> Result<R, MeshError> + Send,
    ) -> PyResult<R> {
        let mut options = meshing.options()?;
        let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
            options.limits.cancel = Some(watch.token());
            let reference = self.1.as_ref();
            asked(&self.0, &MeshOptions { progress: Some(&*watch), reference, ..options })
        })?;
        found.map_err(Raise::raise)
    }
}

#[pymethods]
impl NeuronSkeleton {
    /// Fills the neuron with hexahedra.
    fn mesh<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<MeshParts<'py>> {
        mesh_parts(py, self.run(py, meshing, progress, mesh_neuron)?)
    }

    /// Whether there is a mesh as asked, and where and why not.
    fn check(
        &self,
        py: Python<'_>,
        meshing: Meshing,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(Option<bool>, String)> {
        let found = self.run(py, meshing, progress, meshability)?;
        Ok((found.meshable, written(&found.problems)?))
    }

    /// Fills the neuron with tricubic cells, each cut into this many spline elements along each edge, which are halved in some places.
    #[expect(clippy::needless_pass_by_value, reason = "arguments come from Python")]
    fn splines<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        refine: Vec<String>,
        levels: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<SplineParts<'py>> {
        neuron_flow::splines(
            py,
            Source::Skeleton(&self.0, self.1.as_ref()),
            meshing,
            (&refine, levels),
            progress,
        )
    }

    /// Fills the neuron with tricubic cells and solves for the flow through them.
    fn flow<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        config: &str,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<FlowParts<'py>> {
        neuron_flow::flow(py, Source::Skeleton(&self.0, self.1.as_ref()), meshing, config, progress)
    }
}

/// A mesh as the Python half takes it.
fn mesh_parts(py: Python<'_>, found: NeuronMesh) -> PyResult<MeshParts<'_>> {
    let file = found.vtu().map_err(PyErr::from)?;
    let caps = found.labels.iter().map(|&label| label.cast_signed() - 1).collect::<Vec<_>>();
    let branches = array_of(py, found.parts.clone())?;
    let positions = found.mesh.positions().iter().copied().map(<[f64; 3]>::from).collect();
    let cells = array_of_rows(py, found.mesh.cells().to_vec())?;
    let boundary = found.faces.boundary().iter().map(|face| face.vertices).collect();
    let samples = array_of(py, found.caps.iter().map(|cap| cap.sample).collect())?;
    let report = written(&found.report)?;
    Ok((
        NeuronHexahedra(found),
        array_of_rows(py, positions)?,
        cells,
        branches,
        array_of_rows(py, boundary)?,
        array_of(py, caps)?,
        samples,
        PyBytes::new(py, &file),
        report,
    ))
}

/// The options that make cells of a skeleton, in one line.
#[pyfunction]
pub(crate) fn neuron_options(
    stage: &str,
    parts: usize,
    layer: f64,
    repair: bool,
    steps: usize,
    spacing: Option<f64>,
) -> String {
    Preparation { repair, smooth: SmoothOptions { steps, spacing } }.line(stage, parts, layer)
}

#[pymethods]
impl NeuronHexahedra {
    /// Whether the wall is proven to be within the tolerated distance of the cones, or not to be; `None` where neither is proven or
    /// nothing was compared.
    fn is_within(&self) -> Option<bool> {
        self.0.report.wall.as_ref().and_then(WallDistance::is_within)
    }

    /// Lets material diffuse and be carried through the mesh; goes on from a state.
    fn transport<'py>(
        slf: &Bound<'py, Self>,
        config: &str,
        frames: usize,
        origin: Origin,
        time_limit: Option<f64>,
        memory_limit: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<TransportParts<'py>> {
        let (py, mesh) = (slf.py(), &slf.get().0);
        let parameters = read_transport_config(config).map_err(Raise::raise)?;
        let mut limits = limits(None, time_limit, memory_limit)?;
        let (identity, resume) = origin.resumed(&parameters)?;
        let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
            limits.cancel = Some(watch.token());
            let options = TransportOptions { limits, progress: Some(&*watch), resume: resume.as_ref() };
            transport(mesh, &parameters, frames, &options)
        })?;
        let (cells, mesh) = (RunCells::Mesh(slf.clone().unbind()), mesh.report.clone());
        transport_parts(py, found.map_err(Raise::raise)?, parameters, cells, identity, (Some(mesh), None))
    }

    /// Makes each cell a patch, cut into this many spline elements along each edge, which are halved in some places.
    #[expect(clippy::needless_pass_by_value, reason = "arguments come from Python")]
    fn splines<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        refine: Vec<String>,
        levels: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<SplineParts<'py>> {
        neuron_flow::splines(py, Source::Mesh(&self.0), meshing, (&refine, levels), progress)
    }

    /// Makes each cell a patch, and solves for the flow through them.
    fn flow<'py>(
        &self,
        py: Python<'py>,
        meshing: Meshing,
        config: &str,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<FlowParts<'py>> {
        neuron_flow::flow(py, Source::Mesh(&self.0), meshing, config, progress)
    }
}

/// Reads a hexahedral mesh with ends at the sides of the box around it, or where labels of its vertices are.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "arguments come from Python")]
pub(crate) fn read_neuron_mesh(
    py: Python<'_>,
    path: std::path::PathBuf,
    sides: Vec<String>,
) -> PyResult<MeshParts<'_>> {
    let sides = sides.iter().map(|name| {
        let side = Side::from_name(name).ok_or(MeshError::UnknownSide { name: name.clone() });
        side.map_err(Raise::raise)
    });
    let sides = sides.collect::<PyResult<Vec<_>>>()?;
    let read = py.detach(|| pompeiu::io::read_hexahedra(&path)).map_err(Raise::raise)?;
    let positions = read.positions.into_iter().map(Into::into).collect();
    let found = py.detach(|| {
        let mesh = HexMesh::new(positions, read.cells)?;
        let ends = match &read.labels {
            _ if !sides.is_empty() => Ends::Sides(&sides),
            Some(labels) => Ends::Labels(labels),
            None => Ends::None,
        };
        NeuronMesh::from_hexahedra(mesh, ends, &Limits::default())
    });
    mesh_parts(py, found.map_err(Raise::raise)?)
}

/// What is asked about: the bytes of a skeleton, or a file of a skeleton or a mesh.
pub(crate) fn source(given: &Bound<'_, PyAny>) -> PyResult<NeuronSource> {
    if let Ok(bytes) = given.cast::<PyBytes>() {
        return Ok(NeuronSource::skeleton(bytes.as_bytes().to_vec()));
    }
    let path: std::path::PathBuf = given.extract()?;
    let content = std::fs::read(&path)
        .map_err(|error| NeuronRequestError::File { path: path.clone(), error }.raise())?;
    let name = path.to_string_lossy().to_ascii_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    if ![".vtk", ".vtu"].iter().any(|suffix| name.ends_with(suffix)) {
        return Ok(NeuronSource::skeleton(content));
    }
    let read = pompeiu::io::read_hexahedra(&path).map_err(Raise::raise)?;
    let positions = read.positions.into_iter().map(Into::into).collect();
    let mesh = HexMesh::new(positions, read.cells).map_err(MeshError::from).map_err(Raise::raise)?;
    Ok(NeuronSource::mesh(content, mesh, read.labels))
}

/// What the stages left, as the Python half takes it: a tuple for each of them.
pub(crate) fn answer_parts<'py>(
    py: Python<'py>,
    found: NeuronAnswer,
    request: &NeuronRequest,
) -> PyResult<Bound<'py, PyDict>> {
    let parts = PyDict::new(py);
    let NeuronAnswer { skeleton, original, hexahedra, patches, splines, flow, transported, report, .. } =
        found;
    if let (Some(skeleton), Some(report)) = (skeleton, &report.skeleton) {
        parts.set_item("skeleton", skeleton_parts(py, skeleton, original, report)?)?;
    }
    if let Some(mesh) = hexahedra {
        parts.set_item("mesh", mesh_parts(py, mesh)?)?;
    }
    match (patches, splines, flow) {
        (Some(mesh), _, Some(flow)) => {
            let parameters = request.parameters().map_err(Raise::raise)?.flow;
            parts.set_item("flow", neuron_flow::flow_parts(py, flow, mesh.report, parameters)?)?;
        }
        (Some(mesh), Some(splines), None) => {
            let (file, report) = if request.refine.is_empty() {
                (mesh.vtu(true), SplineReport::new(&mesh.mesh, request.elements))
            } else {
                (refined_vtu(&mesh, &splines, true), SplineReport::of_refined(&splines))
            };
            parts.set_item("splines", neuron_flow::spline_parts(py, mesh, splines, &file?, &report)?)?;
        }
        _ => {}
    }
    if let Some(Transported { cells, found, parameters, run }) = transported {
        let reports = (report.mesh, report.flow);
        let cells = match cells {
            MaterialCells::Hexahedra(mesh) => RunCells::Mesh(Bound::new(py, NeuronHexahedra(mesh))?.unbind()),
            MaterialCells::Flow(cells) => RunCells::Flow(Box::new(cells)),
        };
        parts.set_item("transport", transport_parts(py, found, parameters, cells, run, reports)?)?;
    }
    Ok(parts)
}
