//! Questions about distances.

use crate::errors::{Raise, UnknownOption, unknown};
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait;
use pompeiu::core::run::Limits;
use pompeiu::hausdorff::{self as library, HausdorffOptions, Method, OptionError, Tolerance};
use pyo3::prelude::*;
use serde::Serialize;

/// The options of a question, from a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    tolerance: f64,
    tolerance_kind: String,
    threshold: Option<f64>,
    threads: Option<usize>,
    /// In seconds.
    time_limit: Option<f64>,
    /// In bytes.
    memory_limit: Option<usize>,
    method: String,
}

impl Options {
    fn options(self) -> PyResult<HausdorffOptions<'static>> {
        let options = HausdorffOptions {
            tolerance: tolerance(self.tolerance, &self.tolerance_kind)?,
            threshold: self.threshold,
            limits: limits(self.threads, self.time_limit, self.memory_limit)?,
            method: match self.method.as_str() {
                "fast" => Method::Fast,
                "classic" => Method::Classic,
                found => {
                    let expected = "\"fast\" or \"classic\"";
                    return Err(unknown("method", found, expected));
                }
            },
            ..HausdorffOptions::default()
        };
        options.check().map_err(Raise::raise)?;
        Ok(options)
    }
}

/// Limits on threads, seconds and bytes.
pub(crate) fn limits(
    threads: Option<usize>,
    seconds: Option<f64>,
    memory: Option<usize>,
) -> PyResult<Limits> {
    let time =
        seconds.map(|seconds| Limits::seconds(seconds).map_err(|_| UnknownOption::Time(seconds).raise()));
    let threads = threads.map(|count| Limits::threads(count).map_err(|e| OptionError::from(e).raise()));
    Ok(Limits { time: time.transpose()?, memory, threads: threads.transpose()?, ..Limits::default() })
}

/// A tolerance, from its number and its kind.
pub(crate) fn tolerance(value: f64, kind: &str) -> PyResult<Tolerance> {
    match kind {
        "diagonal" => Ok(Tolerance::RelativeToDiagonal(value)),
        "relative" => Ok(Tolerance::RelativeToDistance(value)),
        "absolute" => Ok(Tolerance::Absolute(value)),
        found => {
            let expected = "\"diagonal\", \"relative\" or \"absolute\"";
            Err(unknown("tolerance_kind", found, expected))
        }
    }
}

/// Asks a question on a thread of its own, and writes down the answer.
fn answer<R: Serialize + Send + 'static>(
    py: Python<'_>,
    options: Options,
    progress: Option<&Bound<'_, PyAny>>,
    ask: impl FnOnce(&HausdorffOptions<'_>) -> Result<R, OptionError> + Send + 'static,
) -> PyResult<String> {
    let options = options.options()?;
    let report = wait::run_detached(py, progress, move |watch| {
        ask(&HausdorffOptions { observer: Some(watch), ..options })
    })?;
    written(&report.map_err(Raise::raise)?)
}

/// A mesh with its tree built: measure many meshes against it.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Target(library::Target);

#[pymethods]
impl Target {
    #[new]
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>) -> PyResult<Self> {
        let mesh = mesh.clone().unbind();
        wait::abandonable(py, move || library::Target::new(mesh.get().inner())).map(Self)
    }

    /// Number of faces.
    #[getter]
    fn n_faces(&self) -> usize {
        self.0.faces()
    }

    /// Bytes of memory held.
    #[getter]
    fn nbytes(&self) -> usize {
        self.0.bytes()
    }

    /// The least and the greatest corner of the bounding box of the faces.
    #[getter]
    fn bounds(&self) -> [(f64, f64, f64); 2] {
        let aabb = self.0.aabb();
        [aabb.lower.into(), aabb.upper.into()]
    }

    /// Encloses how far the points of a mesh are from this one.
    fn directed_from(
        slf: &Bound<'_, Self>,
        py: Python<'_>,
        a: &Bound<'_, Mesh>,
        options: Options,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let (a, target) = (a.clone().unbind(), slf.clone().unbind());
        answer(py, options, progress, move |options| options.directed_to(a.get().inner(), &target.get().0))
    }
}
