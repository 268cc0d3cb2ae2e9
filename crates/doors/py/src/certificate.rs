//! Certificates: written beside an answer, and checked.

use crate::errors::{CertificateFileError, Raise};
use crate::hausdorff::limits;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Share, Watch};
use pompeiu::core::geom::Aabb;
use pompeiu::core::run::Limits;
use pompeiu::hausdorff::VerifyRequest;
use pompeiu::hausdorff::certificate::{CertificateOptions, Goal, write_certificate as write, write_packed};
use pyo3::prelude::*;
use std::fs::File;
use std::io::BufReader;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread;

/// What is to be proven of one direction: the upper end, and the face, the weights and the distance of the witness.
type Ends = (f64, u32, [f64; 3], f64);

/// Writes a certificate, whole or not at all; what it proves as JSON. Upper ends are raised by `slack`, a fraction of the joint diagonal that
/// the question has checked.
#[pyfunction]
pub(crate) fn write_certificate(
    py: Python<'_>,
    path: PathBuf,
    a: Py<Mesh>,
    b: Py<Mesh>,
    ends: (Option<Ends>, Option<Ends>),
    slack: f64,
    given: (Option<usize>, Option<f64>, Option<usize>),
) -> PyResult<String> {
    let (threads, seconds, memory) = given;
    let limits = limits(threads, seconds, memory)?;
    let found = wait::run_detached(py, None, move |watch: &mut Watch<'_, Share>| {
        let (a, b) = (a.get().inner(), b.get().inner());
        let slack = slack * Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal();
        let goal = |(upper, face, weights, lower): Ends| Goal {
            upper: upper + slack,
            witness: Some((face, weights, lower)),
        };
        let goals = [ends.0.map(goal), ends.1.map(goal)];
        let options = CertificateOptions { limits: Limits { cancel: Some(watch.token()), ..limits } };
        pompeiu::io::write_stream(&path, |into| write_packed(into, |into| write(a, b, goals, &options, into)))
            .map_err(|error| CertificateFileError::Write { path, error })
    })?;
    written(&found.map_err(Raise::raise)?)
}

/// Checks a certificate; the report as JSON.
#[pyfunction]
pub(crate) fn verify_certificate(
    py: Python<'_>,
    path: PathBuf,
    a: Py<Mesh>,
    b: Py<Mesh>,
    threads: Option<usize>,
) -> PyResult<String> {
    let threads = limits(threads, None, None)?
        .threads
        .map_or_else(|| thread::available_parallelism().map_or(1, NonZeroUsize::get), NonZeroUsize::get);
    let found = wait::abandonable(py, move || {
        let file = match File::open(&path) {
            Ok(file) => BufReader::new(file),
            Err(error) => return Err(CertificateFileError::Open { path, error }),
        };
        let checked = VerifyRequest {}.run(a.get().inner(), b.get().inner(), file, threads);
        checked.map_err(|error| CertificateFileError::Read { path, error: error.to_string() })
    })?;
    written(&found.map_err(Raise::raise)?)
}
