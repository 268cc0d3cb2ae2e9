//! Both directions, and what they say together.

use super::across::neighbours;
use super::entry::Sum;
use super::frame::frame_of;
use super::grid::Ruler;
use super::linear::{greater, lesser};
use super::memory;
use super::options::DeviationOptions;
use super::outcome::Outcome;
use super::packed::{Entries, are_packed};
use super::pieces::are_summed;
use super::report::{Deviation, DirectedDeviation};
use super::run::{Pair, run};
use super::statistics::{Percentile, StatisticsQuery, Summary, is_narrow};
use super::unknown::{Known, unknown};
use crate::coarse;
use crate::engine::Question;
use crate::options::HausdorffOptions;
use crate::prepared::PreparedPair;
use crate::report::{Direction, StopReason};
use crate::tolerance::OptionError;
use pompeiu_core::TriMesh;
use pompeiu_core::run::Instant;
use pompeiu_core::run::on_threads;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::time::Duration;

/// Trees are not built when there is less time for each face of both meshes.
const LEAST_TIME: Duration = Duration::from_nanos(200);

fn least_time(from: &TriMesh, to: &TriMesh) -> Duration {
    LEAST_TIME * (from.faces().len() as u32).saturating_add(to.faces().len() as u32)
}

/// Neighbours across the edges of B and of A, once a direction needs them: where the time is short none does.
type LazySigns = OnceCell<[Option<Vec<[u32; 2]>>; 2]>;

impl DeviationOptions<'_> {
    /// How far A is from B.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn directed(&self, a: &TriMesh, b: &TriMesh) -> Result<DirectedDeviation, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || {
            let room = self.limits.memory.map(|most| memory::room(most, a, b, 0));
            let pair = PreparedPair::for_one_question(a, b);
            let signs = LazySigns::default();
            self.one_direction(&pair, (Direction::AToB, [0.0, 1.0]), self.deadline(1), room, &signs).report
        }))
    }

    /// How far A and B are from each other. The first direction takes at most half of the time limit, or what a tree takes if that is more, and
    /// half of what the memory limit leaves for pieces.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn symmetric(&self, a: &TriMesh, b: &TriMesh) -> Result<Deviation, OptionError> {
        self.symmetric_of(&PreparedPair::for_one_question(a, b))
    }

    /// The same of a prepared pair: its trees and the distances of its vertices serve what follows, such as
    /// [`Deviation::bands_of`] and figures. Of a pair with parts these are measured, to the other mesh as a whole, and faces in the report
    /// are those of the parts. Where it is known how far a part is at most ([`Part::farthest`](super::Part::farthest)), no more is
    /// reported, even if limits end the work early.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn symmetric_of(&self, pair: &PreparedPair<'_>) -> Result<Deviation, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || self.both_directions(pair)))
    }

    fn both_directions(&self, pair: &PreparedPair<'_>) -> Deviation {
        let (half, whole) = (self.deadline(2), self.deadline(1));
        // So much that the first direction is not left without an answer, even if the other one is.
        let least = 2 * least_time(pair.a(), pair.b());
        let half = half.zip(whole).map(|(half, whole)| half.max(Instant::now() + least).min(whole));
        let [a_part, b_part] = [Direction::AToB, Direction::BToA].map(|direction| pair.measured(direction));
        let (a, b) = (pair.a(), pair.b());
        let room = |from, to, held| self.limits.memory.map(|most| memory::room(most, from, to, held));
        let both = room(a_part, b, 0).zip(room(b_part, a, memory::of_report(a_part)));
        let first = both.map(|(there, back)| there.min(back) / 2);
        let signs = LazySigns::default();
        let told = |direction: Direction| (direction, direction.share_of_both());
        let there = self.one_direction(pair, told(Direction::AToB), half, first, &signs);
        let rest = room(b_part, a, there.bytes() + pair.bytes());
        let back = self.one_direction(pair, told(Direction::BToA), whole, rest, &signs);
        let mut deviation = self.both(a, b, there, back);
        let [there, back] = [&mut deviation.a_to_b, &mut deviation.b_to_a];
        if !self.signed && (there.sides.is_none() || back.sides.is_none()) {
            // One signed and the other not would be read as both.
            for directed in [there, back] {
                (directed.sides, directed.signed) = (None, None);
            }
        }
        deviation
    }

    fn both(&self, a: &TriMesh, b: &TriMesh, there: Outcome, back: Outcome) -> Deviation {
        let (frame, joint, rounding) = frame_of(a, b);
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
            if known {
                outcome.areas.clone()
            } else {
                outcome.pieces.measured().cumulative(largest, self.bins)
            }
        };
        let areas: Vec<Sum> = areas(&there).into_iter().zip(areas(&back)).map(|(x, y)| x.plus(y)).collect();
        let floor = Self::floor(&frame, &joint, rounding);
        let pooled = there.pieces.pooled(back.pieces, |area| Ruler::new(area, rounding, floor));
        let pooled = pooled.measured();
        let asked = StatisticsQuery::of(self, &frame);
        let summary = match there.summary.as_ref().zip(back.summary.as_ref()) {
            Some((x, y)) => {
                let is_narrow = |ends: &(f64, f64)| is_narrow(*ends, self.accuracy, floor);
                let known = Some(between(x, y)).filter(|percentiles| percentiles.iter().all(is_narrow));
                Summary::with(x.sums.plus(y.sums), pooled, &asked, largest, known)
            }
            None => Summary::of(pooled, &asked, largest),
        };
        Deviation {
            distance: there.report.distance.distance.max(back.report.distance.distance),
            greater_percentiles,
            pooled: summary.map(|s| s.publish(&areas, &asked, self.threshold, largest, &frame)),
            a_to_b: there.report,
            b_to_a: back.report,
        }
    }

    /// A direction, which takes the call from one share of it to another.
    fn one_direction(
        &self,
        prepared: &PreparedPair<'_>,
        (direction, share): (Direction, [f64; 2]),
        deadline: Option<Instant>,
        room: Option<usize>,
        signs: &LazySigns,
    ) -> Outcome {
        let started = Instant::now();
        let (from, to) = (prepared.measured(direction), prepared.other(direction));
        let (frame, joint, rounding) = frame_of(from, to);
        let faces = from.faces().len();
        let least_room = if are_summed(self.accuracy, faces + to.faces().len()) {
            Ruler::new(1.0, rounding, Self::floor(&frame, &joint, rounding)).bytes()
        } else {
            Entries::size(are_packed(self.accuracy, faces)) * faces
        };
        let too_small = room.is_some_and(|room| room < least_room);
        let late = deadline.is_some_and(|end| end.saturating_duration_since(started) < least_time(from, to));
        if too_small || late {
            let stop = if too_small { StopReason::Memory } else { StopReason::Time };
            let options = HausdorffOptions::default();
            let question = Question { options: &options, direction, deadline };
            let distance = coarse::bound_quickly(&question, from, to, stop);
            let distance = distance.at_most(prepared.farthest(direction));
            let floor = Self::floor(&frame, &joint, rounding);
            let known = Known { distance, clusters: None, stop };
            return unknown(self, from, &frame, direction, floor, known);
        }
        let target = prepared.target(direction, frame);
        let build = started.elapsed();
        let surface = target.surface(to);
        let neighbours = || {
            let both = signs.get_or_init(|| self.wants_signs(prepared.a(), prepared.b()));
            let of_mesh = both[usize::from(direction == Direction::BToA)].as_deref()?;
            if std::ptr::eq(surface, to) {
                Some(Cow::Borrowed(of_mesh))
            } else {
                neighbours(surface).map(Cow::Owned)
            }
        };
        let neighbours = &neighbours;
        let pair = Pair {
            from,
            to: surface,
            target: &target,
            direction,
            share,
            prepared,
            deadline,
            room,
            neighbours,
        };
        let mut outcome = run(self, &pair);
        outcome.report.work.build = build;
        outcome
    }

    /// Neighbours across the edges of B and of A, where these are closed and oriented and inside is to be told from outside.
    fn wants_signs(&self, a: &TriMesh, b: &TriMesh) -> [Option<Vec<[u32; 2]>>; 2] {
        if self.signed {
            return [neighbours(b), neighbours(a)];
        }
        if !self.signed_where_closed || self.limits.memory.is_some() {
            return [None, None];
        }
        let both = neighbours(b).and_then(|to_b| Some((to_b, neighbours(a)?)));
        both.map_or([None, None], |(to_b, to_a)| [Some(to_b), Some(to_a)])
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
