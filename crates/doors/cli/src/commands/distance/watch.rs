//! Watches the engine: moves the progress bar and keeps the rows of a trace.

use super::args;
use crate::interrupt;
use crate::numbers::between;
use crate::wait::Wait;
use pompeiu::hausdorff::{DirectedReport, Direction, Observer, Progress, Stage, StopReason};
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How far a search had come at one tolerance.
pub(super) struct TraceRow {
    pub(super) direction: Direction,
    /// The tolerance as a fraction of the joint diagonal.
    pub(super) fraction: f64,
    /// The tolerance as a length.
    pub(super) tolerance: f64,
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// Pieces that may still hold the maximum, if they were counted.
    pub(super) pieces: Option<usize>,
    /// Point–triangle distances evaluated so far.
    pub(super) distances: u64,
    pub(super) elapsed: Duration,
}

pub(super) struct Watch<'w> {
    wait: &'w Wait,
    asked: args::Direction,
    /// Stages asked for; the engine may report the end as one more.
    stages: usize,
    rows: Mutex<Vec<TraceRow>>,
}

impl<'w> Watch<'w> {
    pub(super) fn new(wait: &'w Wait, asked: args::Direction, stages: usize) -> Self {
        Self { wait, asked, stages, rows: Mutex::default() }
    }

    /// The rows of the stages, and after those of each direction the one where the search ended.
    pub(super) fn into_rows(
        self,
        ends: [(Direction, Option<&DirectedReport>); 2],
        diagonal: f64,
    ) -> Vec<TraceRow> {
        let mut told = self.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
        let mut rows = Vec::new();
        for (direction, report) in ends {
            rows.extend(told.extract_if(.., |row| row.direction == direction));
            rows.extend(report.map(|report| TraceRow {
                direction,
                fraction: if diagonal > 0.0 { report.tolerance / diagonal } else { 0.0 },
                tolerance: report.tolerance,
                lower: report.distance.lower(),
                upper: report.distance.upper(),
                pieces: (report.stop == StopReason::Tolerance).then_some(0),
                distances: report.work.distances,
                elapsed: report.timing.build + report.timing.search,
            }));
        }
        rows
    }

    /// The direction as the user named the files: a single question is always from the engine's A to its B.
    fn direction(&self, told: Direction) -> Direction {
        if self.asked == args::Direction::BToA { Direction::BToA } else { told }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let ends = match self.direction(progress.direction) {
            Direction::AToB => "A to B",
            Direction::BToA => "B to A",
        };
        self.wait.advance(
            format!("{ends}: {}", between(progress.lower, progress.upper)),
            [progress.examined, progress.examined.saturating_add(progress.left)],
        );
        interrupt::flow()
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
            fraction: super::run::TRACE[index],
            tolerance: stage.tolerance,
            lower: stage.lower,
            upper: stage.upper,
            pieces: Some(stage.remaining.len()),
            distances: stage.distances,
            elapsed: stage.elapsed,
        });
    }
}
