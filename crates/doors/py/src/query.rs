//! Questions about distances.

use crate::errors::{Raise, UnknownOption};
use crate::mesh::Mesh;
use crate::report::{Directed, Symmetric};
use crate::wait;
use pompeiu::hausdorff::{self as library, Method, Query, Tolerance};
use pyo3::prelude::*;
use std::time::Duration;

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
    fn query(self) -> PyResult<Query> {
        let tolerance = tolerance(self.tolerance, &self.tolerance_kind)?;
        let mut query = Query::new().tolerance(tolerance).map_err(Raise::raise)?;
        if let Some(threshold) = self.threshold {
            query = query.threshold(threshold).map_err(Raise::raise)?;
        }
        if let Some(threads) = self.threads {
            query = query.threads(threads).map_err(Raise::raise)?;
        }
        if let Some(seconds) = self.time_limit {
            query = query.time_limit(duration(seconds)?);
        }
        if let Some(bytes) = self.memory_limit {
            query = query.memory_limit(bytes);
        }
        Ok(query.method(match self.method.as_str() {
            "fast" => Method::Fast,
            "classic" => Method::Classic,
            found => {
                let expected = "\"fast\" or \"classic\"";
                return Err(
                    UnknownOption::Name { option: "method", found: found.to_owned(), expected }.raise()
                );
            }
        }))
    }
}

/// A span of time.
pub(crate) fn duration(seconds: f64) -> PyResult<Duration> {
    Duration::try_from_secs_f64(seconds).map_err(|_| UnknownOption::Time(seconds).raise())
}

fn tolerance(value: f64, kind: &str) -> PyResult<Tolerance> {
    match kind {
        "diagonal" => Ok(Tolerance::RelativeToDiagonal(value)),
        "relative" => Ok(Tolerance::RelativeToDistance(value)),
        "absolute" => Ok(Tolerance::Absolute(value)),
        found => {
            let expected = "\"diagonal\", \"relative\" or \"absolute\"";
            Err(UnknownOption::Name { option: "tolerance_kind", found: found.to_owned(), expected }.raise())
        }
    }
}

/// A mesh with its tree built: measure many meshes against it.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Target(library::Target);

#[pymethods]
impl Target {
    #[new]
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>) -> Self {
        let mesh = mesh.get();
        Self(py.detach(|| library::Target::new(mesh.inner())))
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
        &self,
        py: Python<'_>,
        a: &Bound<'_, Mesh>,
        options: Options,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Directed> {
        let query = options.query()?;
        let a = a.get();
        let report = wait::run(py, progress, |watch| query.directed_to_observed(a.inner(), &self.0, watch))?;
        Ok(report.into())
    }
}

/// Encloses how far the points of A are from B.
#[pyfunction]
pub(crate) fn directed_hausdorff(
    py: Python<'_>,
    a: &Bound<'_, Mesh>,
    b: &Bound<'_, Mesh>,
    options: Options,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Directed> {
    let query = options.query()?;
    let (a, b) = (a.get(), b.get());
    let report = wait::run(py, progress, |watch| query.directed_observed(a.inner(), b.inner(), watch))?;
    Ok(report.into())
}

/// Encloses the greater of both directed distances.
#[pyfunction]
pub(crate) fn hausdorff(
    py: Python<'_>,
    a: &Bound<'_, Mesh>,
    b: &Bound<'_, Mesh>,
    options: Options,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Symmetric> {
    let query = options.query()?;
    let (a, b) = (a.get(), b.get());
    let report = wait::run(py, progress, |watch| query.symmetric_observed(a.inner(), b.inner(), watch))?;
    Ok(report.into())
}
