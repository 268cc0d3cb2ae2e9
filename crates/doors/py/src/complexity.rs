//! Outlines: read, generated, and clustered by their distances.

use crate::arrays::array_of_rows;
use crate::errors::{Raise, unknown};
use crate::wait;
use numpy::PyArray2;
use pompeiu::complexity::generate::{self, PointOrder};
use pompeiu::planar::ShapeError;
use pompeiu::planar::silhouette::{Foreground, SilhouetteOptions};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;
use std::path::PathBuf;

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
    let shown = path.display().to_string();
    let found = wait::abandonable(py, move || {
        let found = pompeiu::planar::read_outlines(&path, &options);
        found.map_err(|error| ShapeError::File { path, error })
    })?;
    let (found, missing) = found.map_err(Raise::raise)?;
    for missing in missing {
        let said = CString::new(format!("{shown}: {missing}")).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &said, 1)?;
    }
    found.into_iter().map(|outline| array_of_rows(py, outline.into_points())).collect()
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
