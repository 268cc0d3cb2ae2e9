//! Flow to least area, and simplification.

use crate::errors::{Raise, UnknownOption};
use crate::hausdorff::limits;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Told, Watch};
use pompeiu::core::run::Progress;
use pompeiu::flow::remesh::{SimplifyOptions, SimplifyTarget};
use pompeiu::flow::{BoundaryCondition, FlowOptions, FlowStep, Remeshing, Scheme, Until};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// What is told of a step: its number, the area, the gradient along normals.
struct Step(usize, f64, f64);

impl Told for Step {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.0, self.1, self.2).into_pyobject(py)
    }
}

/// What is told of a simplification: the share that is done.
struct Share(f64);

impl Told for Share {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.0,).into_pyobject(py)
    }
}

/// Options of a flow, as the Python half checks and hands them over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    scheme: Option<String>,
    until: (String, f64),
    time_step: Option<f64>,
    planes: Option<[f64; 3]>,
    keep_volume: bool,
    remesh: Option<(f64, NonZeroUsize)>,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

impl Options {
    fn options(self) -> PyResult<FlowOptions<'static>> {
        let unknown = |option: &'static str, found: String, expected: &'static str| {
            UnknownOption::Name { option, found, expected }.raise()
        };
        let until = match (self.until.0.as_str(), self.until.1) {
            ("stationary", tolerance) => Until::Stationary(tolerance),
            ("time", time) => Until::Time(time),
            ("steps", count) => Until::Steps(count as usize),
            (found, _) => {
                return Err(unknown("until", found.to_owned(), "\"stationary\", \"time\" or \"steps\""));
            }
        };
        let named = |name: String| {
            Scheme::named(&name)
                .ok_or_else(|| unknown("scheme", name, "the name of a scheme, such as \"implicit\""))
        };
        let scheme = self.scheme.map(named).transpose()?;
        Ok(FlowOptions {
            scheme,
            time_step: self.time_step,
            boundary: self.planes.map_or(BoundaryCondition::Fixed, BoundaryCondition::Planes),
            keep_volume: self.keep_volume,
            remesh: self.remesh.map(|(edge_length, every)| Remeshing { edge_length, every }),
            limits: limits(self.threads, self.time_limit, None)?,
            ..FlowOptions::new(until)
        })
    }
}

/// Lets a surface flow to less area.
#[pyfunction]
pub(crate) fn mean_curvature_flow(
    py: Python<'_>,
    mesh: &Bound<'_, Mesh>,
    options: Options,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Mesh, String)> {
    let options = options.options()?;
    let mesh = mesh.get();
    let flow = wait::run(py, progress, |watch: &mut Watch<'_, Step>| {
        let watch = &*watch;
        let observer = |step: &FlowStep<'_>| {
            watch.tell(Step(step.step, step.record.area, step.record.gradient.normal));
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        pompeiu::flow::mean_curvature_flow(
            mesh.inner(),
            &FlowOptions { observer: Some(&observer), ..options },
        )
    })?;
    let flow = flow.map_err(Raise::raise)?;
    Ok((Mesh::from(flow.mesh.clone()), written(&flow)?))
}

/// Reduces the number of faces within a distance, or to a number of faces.
#[pyfunction]
pub(crate) fn simplify(
    py: Python<'_>,
    mesh: &Bound<'_, Mesh>,
    within: Option<f64>,
    faces: usize,
    threads: Option<usize>,
    time_limit: Option<f64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Mesh, String, usize, &'static str)> {
    let target = within.map_or(SimplifyTarget::Faces(faces), SimplifyTarget::Within);
    let limits = limits(threads, time_limit, None)?;
    let mesh = mesh.get();
    let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
        let watch = &*watch;
        let observer = |progress: &Progress<'_>| {
            watch.tell(Share(progress.share.unwrap_or(0.0)));
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let options = SimplifyOptions { limits, progress: Some(&observer), ..SimplifyOptions::new(target) };
        pompeiu::flow::remesh::simplify(mesh.inner(), &options)
    })?;
    let found = found.map_err(Raise::raise)?;
    Ok((Mesh::from(found.mesh), written(&found.distance)?, found.collapses, found.stop.name()))
}
