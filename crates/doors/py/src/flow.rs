//! Flow to least area, remeshing and simplification.

use crate::arrays::{array_of_rows, colors as rgb, faces, vectors};
use crate::errors::{Raise, unknown};
use crate::hausdorff::limits;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Share, Told, Watch};
use numpy::PyArray2;
use pompeiu::core::geom::Aabb;
use pompeiu::core::spatial::self_intersections;
use pompeiu::flow::{BoundaryCondition, FlowOptions, FlowStep, Remeshing, Scheme, Until};
use pompeiu::io::AttributeError;
use pompeiu::remesh::{
    Carrier, CornerValues, Effort, Features, Intersections, RemeshOptions, SimplifyOptions, SimplifyTarget,
    Sizing,
};
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
    let mesh = mesh.clone().unbind();
    let flow = wait::run_detached(py, progress, move |watch: &mut Watch<'_, Step>| {
        let watch = &*watch;
        let observer = |step: &FlowStep<'_>| {
            watch.tell(Step(step.step, step.record.area, step.record.gradient.normal));
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        pompeiu::flow::mean_curvature_flow(
            mesh.get().inner(),
            &FlowOptions { observer: Some(&observer), ..options },
        )
    })?;
    let flow = flow.map_err(Raise::raise)?;
    Ok((Mesh::from(flow.mesh.clone()), written(&flow)?))
}

/// Options of a simplification.
#[derive(Clone, Copy, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct SimplifyChoice {
    within: Option<f64>,
    faces: usize,
    features: Option<f64>,
    repair: bool,
    fast: bool,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

/// Texture coordinates and which of them each corner of each face has.
type Texture<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>);

/// A simplified mesh: the mesh, its distance, the collapses, why it ended, texture coordinates and colours.
type Simple<'py> =
    (Mesh, String, usize, &'static str, Option<Texture<'py>>, Option<Bound<'py, PyArray2<u8>>>);

/// Reduces the number of faces within a distance, or to a number of faces.
#[pyfunction]
pub(crate) fn simplify<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    options: SimplifyChoice,
    texture: Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>,
    colors: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Simple<'py>> {
    let target = options.within.map_or(SimplifyTarget::Faces(options.faces), SimplifyTarget::Within);
    let limits = limits(options.threads, options.time_limit, None)?;
    let held = mesh.clone().unbind();
    let mesh = mesh.get();
    let texture = texture.map(|(coordinates, corners)| {
        let values: Vec<[f64; 2]> = vectors(&coordinates, "texture coordinates", "(k, 2)")?;
        let corners = faces(&corners, values.len())?;
        Carrier::new(mesh.inner(), CornerValues { values, corners }, &[]).map_err(Raise::raise)
    });
    let texture = texture.transpose()?;
    let colors = colors.map(|given| {
        let values: Vec<_> = rgb(given, "colors")?.into_iter().map(|color| color.map(f64::from)).collect();
        let (found, expected) = (values.len(), mesh.inner().positions().len());
        if found != expected {
            return Err(AttributeError::Length {
                name: "colors".into(),
                elements: "vertices",
                expected,
                found,
            }
            .raise());
        }
        let corners = mesh.inner().faces().to_vec();
        Carrier::new(mesh.inner(), CornerValues { values, corners }, &[]).map_err(Raise::raise)
    });
    let colors = colors.transpose()?;
    let seams = texture.as_ref().map(Carrier::seams).unwrap_or_default();
    let found = wait::run_detached(py, progress, move |watch: &mut Watch<'_, Share>| {
        let options = SimplifyOptions {
            features: Features { angle: options.features, edges: &seams, ..Features::default() },
            repair: options.repair,
            effort: if options.fast { Effort::Fast } else { Effort::Best },
            limits,
            progress: Some(&*watch),
            ..SimplifyOptions::new(target)
        };
        pompeiu::remesh::simplify(held.get().inner(), &options)
    })?;
    let found = found.map_err(Raise::raise)?;
    let texture = texture.map(|carrier| {
        let carried = carrier.carry(&found.mesh, &found.kept).map_err(Raise::raise)?;
        PyResult::Ok((array_of_rows(py, carried.values)?, array_of_rows(py, carried.corners)?))
    });
    let colors = colors.map(|carrier| {
        let carried = carrier.at_vertices(&found.mesh).map_err(Raise::raise)?;
        array_of_rows(py, carried.into_iter().map(|color| color.map(|x| x.round() as u8)).collect())
    });
    let (texture, colors) = (texture.transpose()?, colors.transpose()?);
    let distance = written(&found.distance)?;
    Ok((Mesh::from(found.mesh), distance, found.collapses, found.stop.name(), texture, colors))
}

/// Options of remeshing.
#[derive(Clone, Copy, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct RemeshChoice {
    edge_length: Option<f64>,
    chord_height: Option<f64>,
    within: Option<f64>,
    features: Option<f64>,
    iterations: usize,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

/// Least and greatest length of edges that follow curvature, as fractions of the diagonal.
const ADAPTIVE_BETWEEN: [f64; 2] = [1e-4, 0.1];

/// Gives a surface nearly equilateral faces; the quality before and after, the distance, iterations, and why it ended.
#[pyfunction]
pub(crate) fn remesh(
    py: Python<'_>,
    mesh: &Bound<'_, Mesh>,
    options: RemeshChoice,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Mesh, [String; 3], usize, &'static str)> {
    let limits = limits(options.threads, options.time_limit, None)?;
    let mesh = mesh.clone().unbind();
    let diagonal = Aabb::of_faces(mesh.get().inner()).diagonal();
    let sizing = match options.chord_height {
        Some(tolerance) => {
            Sizing::ChordHeight { tolerance, between: ADAPTIVE_BETWEEN.map(|share| share * diagonal) }
        }
        None => Sizing::Length(options.edge_length.unwrap_or(0.0)),
    };
    let found = wait::run_detached(py, progress, move |watch: &mut Watch<'_, Share>| {
        let options = RemeshOptions {
            features: Features { angle: options.features, ..Features::default() },
            within: options.within,
            iterations: options.iterations,
            intersections: Intersections::Ignore,
            limits,
            progress: Some(&*watch),
            ..RemeshOptions::new(sizing)
        };
        pompeiu::remesh::remesh(mesh.get().inner(), &options)
    })?;
    let found = found.map_err(Raise::raise)?;
    let reports = [written(&found.before)?, written(&found.after)?, written(&found.distance)?];
    Ok((Mesh::from(found.mesh), reports, found.iterations, found.stop.name()))
}

/// Pairs of faces, a point of each, a count, and whether these are all.
type Pairs<'py> = (Bound<'py, PyArray2<u32>>, Bound<'py, PyArray2<f64>>, usize, bool);

/// Pairs of faces that intersect, a point of each, how many further pairs only touch, and whether these are all.
#[pyfunction]
pub(crate) fn intersections<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    most_pairs: usize,
) -> PyResult<Pairs<'py>> {
    let mesh = mesh.clone().unbind();
    let found = wait::abandonable(py, move || self_intersections(mesh.get().inner(), most_pairs))?;
    let faces: Vec<[u32; 2]> = found.pairs.iter().map(|pair| pair.faces.map(|f| f.0)).collect();
    let places: Vec<[f64; 3]> = found.pairs.iter().map(|pair| pair.place).collect();
    Ok((array_of_rows(py, faces)?, array_of_rows(py, places)?, found.touching, found.complete))
}
