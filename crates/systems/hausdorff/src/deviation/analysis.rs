//! Both directions, and what they say together.

use super::entry::Sum;
use super::linear::{greater, lesser};
use super::memory;
use super::options::DeviationOptions;
use super::packed::{Entries, are_packed};
use super::report::{Deviation, DirectedDeviation};
use super::run::{Outcome, Pair, run};
use super::statistics::{Percentile, Summary, Wanted, is_narrow};
use super::unknown::unknown;
use crate::coarse;
use crate::engine::{Question, joint_frame};
use crate::options::HausdorffOptions;
use crate::report::{Direction, StopReason};
use crate::target::Target;
use crate::tolerance::OptionError;
use pompeiu_core::TriMesh;
use pompeiu_core::run::on_threads;
use std::time::{Duration, Instant};

/// Trees are not built when there is less time for each face of both meshes.
const LEAST_TIME: Duration = Duration::from_nanos(200);

/// Two meshes, and the parts of them that are measured.
#[derive(Clone, Copy)]
pub(super) struct Ends<'e> {
    pub(super) a_part: &'e TriMesh,
    pub(super) a: &'e TriMesh,
    pub(super) b_part: &'e TriMesh,
    pub(super) b: &'e TriMesh,
    /// How far the parts are at most, where that is known.
    pub(super) farthest: [Option<f64>; 2],
}

impl DeviationOptions<'_> {
    /// How far A is from B.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn directed(&self, a: &TriMesh, b: &TriMesh) -> Result<DirectedDeviation, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || {
            let room = self.limits.memory.map(|most| memory::room(most, a, b, 0));
            self.one_direction([a, b], Direction::AToB, None, self.deadline(1), room).report
        }))
    }

    /// How far A and B are from each other. The first direction takes at most half of the time limit, and half of what the memory
    /// limit leaves for pieces.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn symmetric(&self, a: &TriMesh, b: &TriMesh) -> Result<Deviation, OptionError> {
        self.symmetric_of_parts([a, a], [b, b], [None; 2])
    }

    pub(super) fn of_ends(&self, Ends { a_part, a, b_part, b, farthest }: Ends<'_>) -> Deviation {
        let (half, whole) = (self.deadline(2), self.deadline(1));
        let room = |from, to, held| self.limits.memory.map(|most| memory::room(most, from, to, held));
        let both = room(a_part, b, 0).zip(room(b_part, a, memory::of_report(a_part)));
        let first = both.map(|(there, back)| there.min(back) / 2);
        let there = self.one_direction([a_part, b], Direction::AToB, farthest[0], half, first);
        let rest = room(b_part, a, there.bytes());
        let back = self.one_direction([b_part, a], Direction::BToA, farthest[1], whole, rest);
        self.both(a, b, there, back)
    }

    fn both(&self, a: &TriMesh, b: &TriMesh, there: Outcome, back: Outcome) -> Deviation {
        let (frame, joint, rounding) = joint_frame(a, b);
        let greater_percentiles = there.summary.as_ref().zip(back.summary.as_ref()).map(|(x, y)| {
            let both = x.percentiles.iter().zip(&y.percentiles);
            let greater = both.map(|(x, y)| super::run::greater_of(*x, *y));
            let published = self.percentiles.iter().zip(greater);
            published
                .map(|(share, (low, high))| Percentile {
                    share: *share,
                    distance: super::statistics::length_out(&frame, low, high),
                })
                .collect()
        });
        let largest = greater(there.largest, back.largest);
        let areas = |outcome: &Outcome| {
            let known = outcome.largest == largest && !outcome.areas.is_empty();
            if known { outcome.areas.clone() } else { outcome.distribution.cumulative(largest, self.bins) }
        };
        let areas: Vec<Sum> = areas(&there).into_iter().zip(areas(&back)).map(|(x, y)| x.plus(y)).collect();
        let mut pooled = there.distribution;
        pooled.portions.extend(back.distribution.portions);
        let wanted = Wanted::of(self, &frame);
        let summary = match there.summary.as_ref().zip(back.summary.as_ref()) {
            Some((x, y)) => {
                let floor = Self::floor(&frame, &joint, rounding);
                let is_narrow = |ends: &(f64, f64)| is_narrow(*ends, self.accuracy, floor);
                let known = Some(between(x, y)).filter(|percentiles| percentiles.iter().all(is_narrow));
                Summary::with(x.sums.plus(y.sums), &pooled, &wanted, largest, known)
            }
            None => Summary::of(&pooled, &wanted, largest),
        };
        Deviation {
            distance: there.report.distance.distance.max(back.report.distance.distance),
            greater_percentiles,
            pooled: summary.map(|s| s.publish(&areas, &wanted, self.threshold, largest, &frame)),
            a_to_b: there.report,
            b_to_a: back.report,
        }
    }

    fn one_direction(
        &self,
        [from, to]: [&TriMesh; 2],
        direction: Direction,
        farthest: Option<f64>,
        deadline: Option<Instant>,
        room: Option<usize>,
    ) -> Outcome {
        let started = Instant::now();
        let (frame, joint, rounding) = joint_frame(from, to);
        let faces = from.faces().len() as u32;
        let least_time = LEAST_TIME * faces.saturating_add(to.faces().len() as u32);
        let size = Entries::size(are_packed(self.accuracy, faces as usize));
        let too_small = room.is_some_and(|room| room / size < faces as usize);
        let late = deadline.is_some_and(|end| end.saturating_duration_since(started) < least_time);
        if too_small || late {
            let stop = if too_small { StopReason::Memory } else { StopReason::Time };
            let options = HausdorffOptions::default();
            let question = Question { options: &options, direction, deadline };
            let distance = coarse::bound_quickly(&question, from, to, stop).at_most(farthest);
            let floor = Self::floor(&frame, &joint, rounding);
            return unknown(self, from, &frame, direction, floor, distance, stop);
        }
        let target = Target::in_frame(to, frame);
        let build = started.elapsed();
        let pair = Pair { from, to, target: &target, direction, farthest, deadline, room };
        let mut outcome = run(self, &pair);
        outcome.report.work.build = build;
        outcome
    }

    /// When a part of the time limit has run out.
    fn deadline(&self, part: u32) -> Option<Instant> {
        self.limits.time.and_then(|limit| Instant::now().checked_add(limit / part))
    }
}

/// Encloses the percentiles of two distributions together by those of each: up to the greater of both levels, both have their share of
/// the area, and below the lesser, neither.
fn between(x: &Summary, y: &Summary) -> Vec<(f64, f64)> {
    let both = x.percentiles.iter().zip(&y.percentiles);
    both.map(|(x, y)| (lesser(x.0, y.0), greater(x.1, y.1))).collect()
}
