//! What is reported, however it is printed.

use super::watch::TraceRow;
use crate::args::ToleranceKind;
use crate::exit::Exit;
use pompeiu::core::TriMesh;
use pompeiu::hausdorff::{DirectedReport, Enclosure, StopReason};
use std::path::Path;
use std::time::Duration;

/// A mesh file that was measured.
pub(super) struct File {
    pub(super) path: String,
    pub(super) vertices: usize,
    pub(super) faces: usize,
}

impl File {
    pub(super) fn new(path: &Path, mesh: &TriMesh) -> Self {
        Self { path: path.display().to_string(), vertices: mesh.positions().len(), faces: mesh.faces().len() }
    }
}

/// Wall-clock times that the engine does not know.
pub(super) struct Times {
    pub(super) read: Duration,
    pub(super) total: Duration,
}

/// Whether the distance is at most the threshold.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Answer {
    Below,
    Above,
    Undecided,
}

/// Everything there is to report; at least one direction was asked for.
pub(super) struct Outcome {
    pub(super) a: File,
    pub(super) b: File,
    pub(super) requested: f64,
    pub(super) kind: ToleranceKind,
    pub(super) a_to_b: Option<DirectedReport>,
    pub(super) b_to_a: Option<DirectedReport>,
    pub(super) threshold: Option<f64>,
    pub(super) trace: Option<Vec<TraceRow>>,
    pub(super) times: Times,
}

impl Outcome {
    /// The directions that were asked for.
    pub(super) fn reports(&self) -> impl Iterator<Item = &DirectedReport> {
        self.a_to_b.iter().chain(&self.b_to_a)
    }

    /// Encloses H(A, B), if both directions were asked for.
    pub(super) fn hausdorff(&self) -> Option<Enclosure> {
        Some(self.a_to_b.as_ref()?.distance.max(self.b_to_a.as_ref()?.distance))
    }

    /// Width of the enclosure asked for, as a length.
    pub(super) fn tolerance(&self) -> f64 {
        self.reports().map(|report| report.tolerance).fold(0.0, |m, x| if x > m { x } else { m })
    }

    /// Building trees, all directions together.
    pub(super) fn build(&self) -> Duration {
        self.reports().map(|report| report.timing.build).sum()
    }

    /// Searching, all directions together.
    pub(super) fn search(&self) -> Duration {
        self.reports().map(|report| report.timing.search).sum()
    }

    /// The threshold and the answer, if there was a question.
    pub(super) fn answer(&self) -> Option<(f64, Answer)> {
        let threshold = self.threshold?;
        let answer = if self.reports().any(|report| report.distance.lower() > threshold) {
            Answer::Above
        } else if self.reports().all(|report| report.distance.upper() <= threshold) {
            Answer::Below
        } else {
            Answer::Undecided
        };
        Some((threshold, answer))
    }

    /// What the exit code should say.
    pub(super) fn exit(&self) -> Exit {
        let is_short_of =
            |stop| matches!(stop, StopReason::Time | StopReason::Memory | StopReason::Cancelled);
        match self.answer() {
            Some((_, Answer::Above)) => Exit::Above,
            Some((_, Answer::Undecided)) => Exit::Undecided,
            None if self.reports().any(|report| is_short_of(report.stop)) => Exit::Undecided,
            Some((_, Answer::Below)) | None => Exit::Done,
        }
    }
}
