//! What can be asked of two meshes: their distance in one direction or both, whether it is at most a length, how the search narrowed it.

use super::watch::tell;
use crate::certificate::{CertificateAnswer, Goal};
use crate::tolerance::check_slack;
use crate::{
    DirectedReport, Direction, Enclosure, HausdorffOptions, Method, Observer, OptionError, PointPair,
    Progress, Stage, StopReason, Timing, Tolerance, WorkCount,
};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::request::{Conclusion, Length, Limit, Report, Request};
use pompeiu_core::run::{ProgressObserver, RunContext};
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::fraction;

/// The tolerances of a trace, fractions of the joint diagonal.
const TRACE: [f64; 14] =
    [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

/// Enclose the distance between two meshes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DistanceRequest {
    /// Largest width of the proven intervals.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = fraction, allow_negative_numbers = true, value_name = "X")
    )]
    pub tolerance: f64,
    /// The unit of the tolerance.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub tolerance_kind: ToleranceKind,
    /// The directed distances to compute.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub direction: Directions,
    /// Ask only whether the distance is at most this length, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal of both meshes, and stop at
    /// the first proof.
    #[cfg_attr(
        feature = "clap",
        arg(long = "within", alias = "assert-below", allow_negative_numbers = true, value_name = "LENGTH")
    )]
    pub assert_below: Option<Length>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
    /// The search method.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub method: Method,
    /// Show how the interval narrows: a row per tolerance 1e-1, 1e-2, ... of the diagonal.
    #[cfg_attr(feature = "clap", arg(long))]
    pub trace: bool,
    /// Raise the upper ends that a certificate states by this fraction of the diagonal: the more, the shorter it is.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = fraction, allow_negative_numbers = true, value_name = "X")
    )]
    pub certificate_slack: f64,
}

impl Default for DistanceRequest {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::DEFAULT_FRACTION,
            tolerance_kind: ToleranceKind::default(),
            direction: Directions::default(),
            assert_below: None,
            unit: String::new(),
            method: Method::default(),
            trace: false,
            certificate_slack: Goal::SLACK,
        }
    }
}

/// The unit of a tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ToleranceKind {
    /// The diagonal of the box around both meshes.
    #[default]
    Diagonal,
    /// The distance itself.
    Relative,
    /// The unit of the files.
    Absolute,
}

impl ToleranceKind {
    /// The tolerance of this kind.
    pub const fn of(self, value: f64) -> Tolerance {
        match self {
            Self::Diagonal => Tolerance::RelativeToDiagonal(value),
            Self::Relative => Tolerance::RelativeToDistance(value),
            Self::Absolute => Tolerance::Absolute(value),
        }
    }
}

/// Directed distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Directions {
    /// From A to B and from B to A: the symmetric distance.
    #[default]
    Both,
    /// From A to B: how far points of A are from B.
    AToB,
    /// From B to A: how far points of B are from A.
    BToA,
}

/// Both directed distances with the points that prove them. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DistanceReport {
    /// The width of the interval that was asked for.
    pub tolerance: AskedTolerance,
    /// The distance of A from B; absent if only the other direction was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub a_to_b: Option<DirectedDistance>,
    /// The distance of B from A; absent if only the other direction was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub b_to_a: Option<DirectedDistance>,
    /// The Pompeiu–Hausdorff distance, the greater of both directed ones; absent if only one was asked for.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hausdorff: Option<Enclosure>,
    /// Whether the distance is at most a length; absent if that was not asked.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub threshold: Option<ThresholdAnswer>,
    /// The interval after each stage; absent if not requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub trace: Option<Vec<TraceRow>>,
    /// The outcome of the certificate; absent if none was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<CertificateAnswer>,
    /// Time spent on both directions, in milliseconds.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

/// The width of the interval that was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AskedTolerance {
    /// The number as given.
    pub requested: f64,
    /// Its unit.
    pub kind: ToleranceKind,
    /// The same as a length.
    pub absolute: f64,
}

/// One of the two directed distances.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectedDistance {
    /// The interval that is proven to hold it.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub distance: Enclosure,
    /// The reason for which the search ended; the interval holds in every case.
    pub stop: StopReason,
    /// The width that was asked for, as a length.
    pub tolerance: f64,
    /// The points that prove the lower end.
    pub witness: PointPair,
    /// The work that was done.
    pub work: WorkCount,
    /// Time spent, in milliseconds.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl DirectedDistance {
    fn new(report: &DirectedReport, direction: Direction) -> Self {
        let DirectedReport { distance, stop, tolerance, work, timing, .. } = *report;
        Self { distance, stop, tolerance, witness: report.witness.by_mesh(direction), work, timing }
    }
}

/// Whether the distance is at most a length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ThresholdAnswer {
    /// The length.
    pub value: f64,
    /// The proven statement.
    pub answer: Comparison,
}

/// Whether a distance is at most a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Comparison {
    /// It is, proven.
    Below,
    /// It is not, proven.
    Above,
    /// Neither is proven.
    Undecided,
}

/// The state of a search at one tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TraceRow {
    /// The direction searched.
    pub direction: Direction,
    /// A fraction of the joint diagonal.
    pub tolerance: f64,
    /// The same as a length.
    pub absolute: f64,
    /// Lower bound so far.
    pub lower: f64,
    /// Upper bound so far.
    pub upper: f64,
    /// Pieces that may still hold the maximum; null where the search was stopped.
    pub pieces: Option<usize>,
    /// Point–triangle distances evaluated so far.
    pub distances: u64,
    /// Time so far.
    #[cfg_attr(
        feature = "serde",
        serde(rename = "time_ms", serialize_with = "pompeiu_core::run::as_milliseconds::serialize")
    )]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub elapsed: Duration,
}

impl Request for DistanceRequest {
    const NAME: &'static str = "distance";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = DistanceReport;
}

impl DistanceReport {
    /// The directions that were asked for.
    pub fn directions(&self) -> impl Iterator<Item = &DirectedDistance> {
        self.a_to_b.iter().chain(&self.b_to_a)
    }
}

impl Report for DistanceReport {
    /// The reason of the direction that ended early, if one did.
    fn stop(&self) -> StopReason {
        let reasons = || self.directions().map(|one| one.stop);
        let early = reasons().find(|stop| stop.is_early());
        let first = early.or_else(|| reasons().find(|stop| *stop == StopReason::Rounding));
        first.or_else(|| reasons().next()).unwrap_or(StopReason::Tolerance)
    }

    /// A question about a threshold is answered or not; otherwise limits decide, and whether the certificate was written that was asked for.
    fn conclusion(&self) -> Conclusion {
        match self.threshold.map(|threshold| threshold.answer) {
            Some(Comparison::Above) => Conclusion::Refuted,
            Some(Comparison::Undecided) => Conclusion::Incomplete,
            None if self.stop().is_early() => Conclusion::Incomplete,
            _ if self.certificate.as_ref().is_some_and(|answer| answer.written.is_none()) => {
                Conclusion::Incomplete
            }
            Some(Comparison::Below) | None => Conclusion::AsAsked,
        }
    }
}

impl DistanceRequest {
    /// Encloses the distance of two meshes. An observer sees what the search tells, beside the observer of the context.
    ///
    /// # Errors
    /// [`OptionError`].
    pub fn run(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        context: &RunContext<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<DistanceReport, OptionError> {
        check_slack(self.certificate_slack)?;
        let diagonal = Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal();
        let threshold =
            self.assert_below.as_ref().map(|length| length.of(&self.unit, diagonal)).transpose()?;
        let stages = self.stages(diagonal);
        let watch = Watch {
            progress: context.progress(),
            observer,
            directions: self.direction,
            stages: stages.len(),
            rows: Mutex::default(),
        };
        let options = HausdorffOptions {
            tolerance: self.tolerance_kind.of(self.tolerance),
            threshold,
            stages: stages.to_vec(),
            method: self.method,
            limits: context.limits(),
            observer: Some(&watch),
        };
        let (a_to_b, b_to_a) = match self.direction {
            Directions::Both => {
                let report = options.symmetric(a, b)?;
                (Some(report.a_to_b), Some(report.b_to_a))
            }
            Directions::AToB => (Some(options.directed(a, b)?), None),
            Directions::BToA => (None, Some(options.directed(b, a)?)),
        };
        let trace = self.trace.then(|| watch.into_rows([a_to_b.as_ref(), b_to_a.as_ref()], diagonal));
        Ok(self.report(
            a_to_b.map(|report| DirectedDistance::new(&report, Direction::AToB)),
            b_to_a.map(|report| DirectedDistance::new(&report, Direction::BToA)),
            threshold,
            trace,
        ))
    }

    /// What follows from the directed distances that were asked for.
    fn report(
        &self,
        a_to_b: Option<DirectedDistance>,
        b_to_a: Option<DirectedDistance>,
        threshold: Option<f64>,
        trace: Option<Vec<TraceRow>>,
    ) -> DistanceReport {
        let both = || a_to_b.iter().chain(&b_to_a);
        let absolute = both().map(|one| one.tolerance).fold(0.0, |m, x| if x > m { x } else { m });
        let threshold = threshold.map(|value| ThresholdAnswer {
            value,
            answer: if both().any(|one| one.distance.lower() > value) {
                Comparison::Above
            } else if both().all(|one| one.distance.upper() <= value) {
                Comparison::Below
            } else {
                Comparison::Undecided
            },
        });
        let timing = Timing {
            build: both().map(|one| one.timing.build).sum(),
            search: both().map(|one| one.timing.search).sum(),
        };
        DistanceReport {
            tolerance: AskedTolerance { requested: self.tolerance, kind: self.tolerance_kind, absolute },
            a_to_b,
            b_to_a,
            hausdorff: a_to_b.zip(b_to_a).map(|(there, back)| there.distance.max(back.distance)),
            threshold,
            trace,
            certificate: None,
            timing,
        }
    }

    /// The tolerances of the trace that are coarser than the one asked for; the last row is that of the answer.
    fn stages(&self, diagonal: f64) -> &'static [f64] {
        if !self.trace {
            return &[];
        }
        let finest = match self.tolerance_kind {
            ToleranceKind::Diagonal => self.tolerance,
            ToleranceKind::Absolute => self.tolerance / diagonal,
            ToleranceKind::Relative => 0.0,
        };
        let is_coarser = |stage: &f64| *stage > 1.001 * finest;
        &TRACE[..TRACE.partition_point(is_coarser)]
    }
}

/// Keeps the rows of a trace, and passes progress on.
struct Watch<'w> {
    progress: Option<&'w dyn ProgressObserver>,
    observer: Option<&'w dyn Observer>,
    directions: Directions,
    /// Stages asked for; the engine may report the end as one more.
    stages: usize,
    rows: Mutex<Vec<TraceRow>>,
}

impl Watch<'_> {
    /// The rows of the stages, and after those of each direction the one where the search ended.
    fn into_rows(self, ends: [Option<&DirectedReport>; 2], diagonal: f64) -> Vec<TraceRow> {
        let mut told = self.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
        let mut rows = Vec::new();
        for (direction, report) in [Direction::AToB, Direction::BToA].into_iter().zip(ends) {
            rows.extend(told.extract_if(.., |row| row.direction == direction));
            rows.extend(report.map(|report| TraceRow {
                direction,
                tolerance: if diagonal > 0.0 { report.tolerance / diagonal } else { 0.0 },
                absolute: report.tolerance,
                lower: report.distance.lower(),
                upper: report.distance.upper(),
                pieces: (report.stop == StopReason::Tolerance).then_some(0),
                distances: report.work.distances,
                elapsed: report.timing.build + report.timing.search,
            }));
        }
        rows
    }

    /// The direction as the meshes were given: a single question is always from the engine's A to its B.
    fn direction(&self, told: Direction) -> Direction {
        if self.directions == Directions::BToA { Direction::BToA } else { told }
    }

    /// From which share of the call to which a direction takes it.
    fn share(&self, told: Direction) -> [f64; 2] {
        if self.directions == Directions::Both { told.share_of_both() } else { [0.0, 1.0] }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let progress = progress.as_stage(self.share(progress.direction));
        let progress = Progress { direction: self.direction(progress.direction), ..progress };
        if let Some(observer) = self.observer {
            observer.progress(&progress)?;
        }
        self.progress.map_or(ControlFlow::Continue(()), |watching| tell(watching, &progress, None))
    }

    fn stage(&self, stage: &Stage) {
        let direction = self.direction(stage.direction);
        let mut rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        let index = rows.iter().filter(|row| row.direction == direction).count();
        if index >= self.stages {
            return;
        }
        rows.push(TraceRow {
            direction,
            tolerance: TRACE[index],
            absolute: stage.tolerance,
            lower: stage.lower,
            upper: stage.upper,
            pieces: Some(stage.remaining.len()),
            distances: stage.distances,
            elapsed: stage.elapsed,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SurfacePoint;
    use pompeiu_core::FaceId;

    fn directed([lower, upper]: [f64; 2], stop: StopReason) -> DirectedDistance {
        let point = SurfacePoint { face: FaceId(0), barycentric: [1.0, 0.0, 0.0], position: [0.0; 3] };
        DirectedDistance {
            distance: Enclosure::new(lower, upper).unwrap(),
            stop,
            tolerance: 0.0,
            witness: PointPair { a: point, b: point },
            work: WorkCount::default(),
            timing: Timing::default(),
        }
    }

    fn conclusion(
        a_to_b: Option<DirectedDistance>,
        b_to_a: Option<DirectedDistance>,
        assert_below: Option<f64>,
    ) -> Conclusion {
        DistanceRequest::default().report(a_to_b, b_to_a, assert_below, None).conclusion()
    }

    #[test]
    fn below_takes_both_directions_and_above_only_one() {
        let at = |enclosure| Some(directed(enclosure, StopReason::Tolerance));
        for (a_to_b, b_to_a, expected) in [
            (at([0.1, 0.2]), at([0.3, 0.5]), Conclusion::AsAsked),
            (at([0.1, 0.2]), at([0.4, 0.6]), Conclusion::Incomplete),
            (at([0.4, 0.6]), at([0.1, 0.2]), Conclusion::Incomplete),
            (at([0.1, 0.2]), at([0.6, 0.7]), Conclusion::Refuted),
            (at([0.4, 0.6]), at([0.6, 0.7]), Conclusion::Refuted),
            (at([0.5, 0.5]), None, Conclusion::AsAsked),
            (None, at([0.6, 0.7]), Conclusion::Refuted),
        ] {
            assert_eq!(conclusion(a_to_b, b_to_a, Some(0.5)), expected);
        }
    }

    #[test]
    fn without_a_question_only_limits_leave_it_incomplete() {
        for (stop, expected) in [
            (StopReason::Tolerance, Conclusion::AsAsked),
            (StopReason::Rounding, Conclusion::AsAsked),
            (StopReason::Time, Conclusion::Incomplete),
            (StopReason::Memory, Conclusion::Incomplete),
        ] {
            let done = directed([1.0, 1.0], StopReason::Tolerance);
            assert_eq!(conclusion(Some(done), Some(directed([0.0, 2.0], stop)), None), expected);
        }
    }
}
