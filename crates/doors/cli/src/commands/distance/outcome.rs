//! What is reported, however it is printed.

use super::watch::TraceRow;
use crate::args::ToleranceKind;
use crate::exit::Exit;
use crate::pair::File;
use pompeiu::hausdorff::{DirectedReport, Enclosure};
use pompeiu::matching::align::Registration;
use serde::Serialize;
use std::time::Duration;

/// Wall-clock times that the engine does not know.
pub(super) struct Times {
    pub(super) read: Duration,
    pub(super) total: Duration,
}

/// Whether the distance is at most the threshold.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(super) enum Answer {
    /// It is, proven.
    Below,
    /// It is not, proven.
    Above,
    /// Neither is proven.
    Undecided,
}

/// Everything there is to report; at least one direction was asked for.
pub(super) struct Outcome {
    /// What the two are called.
    pub(super) names: [&'static str; 2],
    pub(super) a: File,
    pub(super) b: File,
    /// How B was moved, if it was.
    pub(super) alignment: Option<Registration>,
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
        match self.answer() {
            Some((_, Answer::Above)) => Exit::Above,
            Some((_, Answer::Undecided)) => Exit::Undecided,
            None if self.reports().any(|report| report.stop.is_early()) => Exit::Undecided,
            Some((_, Answer::Below)) | None => Exit::Done,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu::core::FaceId;
    use pompeiu::hausdorff::{StopReason, SurfacePoint, Timing, Witness, WorkCount};

    fn report([lower, upper]: [f64; 2], stop: StopReason) -> DirectedReport {
        let point = SurfacePoint { face: FaceId(0), barycentric: [1.0, 0.0, 0.0], position: [0.0; 3] };
        DirectedReport {
            distance: Enclosure::new(lower, upper).unwrap(),
            witness: Witness { from: point, to: point },
            stop,
            tolerance: 0.0,
            work: WorkCount::default(),
            timing: Timing::default(),
        }
    }

    fn outcome(
        a_to_b: Option<DirectedReport>,
        b_to_a: Option<DirectedReport>,
        threshold: Option<f64>,
    ) -> Outcome {
        let file = || File { path: String::new(), vertices: 3, faces: 1 };
        let times = Times { read: Duration::ZERO, total: Duration::ZERO };
        let (names, alignment, trace) = (["A", "B"], None, None);
        let (a, b, kind, requested) = (file(), file(), ToleranceKind::Diagonal, 0.0);
        Outcome { names, a, b, alignment, requested, kind, a_to_b, b_to_a, threshold, trace, times }
    }

    #[test]
    fn below_takes_both_directions_and_above_only_one() {
        let at = |enclosure| Some(report(enclosure, StopReason::Tolerance));
        for (a_to_b, b_to_a, exit) in [
            (at([0.1, 0.2]), at([0.3, 0.5]), Exit::Done),
            (at([0.1, 0.2]), at([0.4, 0.6]), Exit::Undecided),
            (at([0.4, 0.6]), at([0.1, 0.2]), Exit::Undecided),
            (at([0.1, 0.2]), at([0.6, 0.7]), Exit::Above),
            (at([0.4, 0.6]), at([0.6, 0.7]), Exit::Above),
            (at([0.5, 0.5]), None, Exit::Done),
            (None, at([0.6, 0.7]), Exit::Above),
        ] {
            assert!(outcome(a_to_b, b_to_a, Some(0.5)).exit() == exit);
        }
    }

    #[test]
    fn without_a_question_only_budgets_leave_it_undecided() {
        for (stop, exit) in [
            (StopReason::Tolerance, Exit::Done),
            (StopReason::Rounding, Exit::Done),
            (StopReason::Time, Exit::Undecided),
            (StopReason::Memory, Exit::Undecided),
        ] {
            let done = report([1.0, 1.0], StopReason::Tolerance);
            assert_eq!(outcome(Some(done), Some(report([0.0, 2.0], stop)), None).exit(), exit);
        }
    }
}
