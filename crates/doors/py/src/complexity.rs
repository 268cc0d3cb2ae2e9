//! Outlines and how complex they are.

use crate::arrays::{array_of_rows, vectors};
use crate::errors::{Raise, ShapeFileError, unknown};
use crate::hausdorff::limits;
use crate::json::written;
use crate::wait::{self, Share, Watch};
use numpy::PyArray2;
use pompeiu::complexity::generate::{self, PointOrder};
use pompeiu::complexity::{AnalyseOptions, MeasureOptions, Shape};
use pompeiu::planar::Outline;
use pompeiu::planar::silhouette::{Foreground, SilhouetteOptions};
use pyo3::prelude::*;
use std::path::PathBuf;

/// What is asked of shapes, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Analysis {
    rank_by: String,
    against: Option<Vec<(String, f64)>>,
    clusters: Option<usize>,
    features: Vec<String>,
    smoothing: f64,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

/// Outlines of shape (n, 2) each.
pub(crate) fn outline(points: &Bound<'_, PyAny>) -> PyResult<Outline> {
    let points = vectors::<2>(points, "the outline", "(n, 2)")?;
    Outline::new(points).map_err(Raise::raise)
}

/// The outlines in a file: a picture, a drawing or a list of points.
#[pyfunction]
pub(crate) fn read_outlines(
    py: Python<'_>,
    path: PathBuf,
    level: Option<f64>,
    foreground: String,
    staircase: bool,
) -> PyResult<Vec<Bound<'_, PyArray2<f64>>>> {
    let foreground = match foreground.as_str() {
        "auto" => Foreground::Auto,
        "dark" => Foreground::Dark,
        "light" => Foreground::Light,
        _ => return Err(unknown("foreground", foreground, "\"auto\", \"dark\" or \"light\"")),
    };
    let options = SilhouetteOptions { level, foreground, staircase };
    let found = wait::abandonable(py, move || {
        let found = pompeiu::planar::read_outlines(&path, &options);
        found.map_err(|error| ShapeFileError { path, error })
    })?;
    let found = found.map_err(Raise::raise)?;
    found.into_iter().map(|outline| array_of_rows(py, outline.into_points())).collect()
}

/// Measures, ranks and clusters outlines.
#[pyfunction]
pub(crate) fn complexity(
    py: Python<'_>,
    shapes: Vec<(String, Bound<'_, PyAny>)>,
    analysis: Analysis,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let shapes = shapes
        .into_iter()
        .map(|(file, points)| Ok(Shape { file, outline: outline(&points)? }))
        .collect::<PyResult<Vec<_>>>()?;
    let options = AnalyseOptions {
        measure: MeasureOptions { smoothing: analysis.smoothing },
        rank_by: analysis.rank_by,
        against: analysis.against,
        clusters: analysis.clusters,
        features: analysis.features,
        limits: limits(analysis.threads, analysis.time_limit, None)?,
        progress: None,
    };
    let report = wait::run_detached(py, progress, move |watch: &mut Watch<'_, Share>| {
        pompeiu::complexity::analyse(&shapes, &AnalyseOptions { progress: Some(&*watch), ..options })
    })?;
    written(&report.map_err(Raise::raise)?)
}

/// Medoids from a start by swaps: the sum of distances to the nearest one, and the medoids.
#[pyfunction]
pub(crate) fn k_medoids(
    py: Python<'_>,
    distances: Vec<Vec<f64>>,
    start: Vec<usize>,
) -> PyResult<(f64, Vec<usize>)> {
    wait::abandonable(py, move || pompeiu::complexity::faster_pam(&distances, start))
}

/// The closed curve through random points.
#[pyfunction]
pub(crate) fn polyline(
    py: Python<'_>,
    points: usize,
    seed: u64,
    order: String,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let order = match order.as_str() {
        "random" => PointOrder::Random,
        "angle" => PointOrder::Angle,
        _ => return Err(unknown("order", order, "\"random\" or \"angle\"")),
    };
    let outline = generate::polyline(points, seed, order).map_err(Raise::raise)?;
    array_of_rows(py, outline.into_points())
}

/// A circle of pixels with noise.
#[pyfunction]
pub(crate) fn noisy_circle(
    py: Python<'_>,
    radius: u32,
    level: u32,
    steps: u32,
    seed: u64,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let outline = generate::noisy_circle(radius, level, steps, seed).map_err(Raise::raise)?;
    array_of_rows(py, outline.into_points())
}
