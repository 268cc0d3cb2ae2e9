//! Rounds of refinement, until statistics are as narrow as asked.

use super::distribution::{Distribution, Entry, area_of};
use super::envelope::Piece;
use super::linear::greater;
use super::options::DeviationOptions;
use super::rounds::{Goal, Made, Workshop};
use super::statistics::{Summary, Wanted};

/// Pieces of one root in the first round, and in later ones.
const FIRST_PIECES: usize = 1024;
const LATER_PIECES: usize = 256;
/// The width of pieces at first, as a part of what the mean is allowed: most pieces come out much better.
const FIRST_PART: f64 = 2.0;
/// How much finer each round is.
const FINER: f64 = 0.5;
/// Part of the allowed width of the mean that pieces which are not cut for being negligible may use up, one for each face.
const NEGLIGIBLE: f64 = 0.05;
/// Rounds that make only statistics of parts of the distribution narrower.
const FOCUSED_ROUNDS: u32 = 12;
/// A focused round must narrow what is not yet narrow enough by this factor, or it was the last.
const LEAST_PROGRESS: f64 = 0.95;

/// One direction's pieces, and what they are made for.
pub(super) struct Refinery<'r, 'w> {
    pub(super) query: &'r DeviationOptions<'r>,
    pub(super) shop: &'r Workshop<'w>,
    pub(super) areas: &'r [(f64, f64)],
    pub(super) wanted: &'r Wanted<'r>,
    pub(super) floor: f64,
    pub(super) largest: f64,
    pub(super) total: f64,
    pub(super) made: Made,
    pub(super) rounds: u32,
    pub(super) watch: &'r mut dyn FnMut(&Made, usize),
}

impl Refinery<'_, '_> {
    /// Returns the distribution, what it says, and whether that is as narrow as asked.
    pub(super) fn run(&mut self, roots: Vec<Piece>, scale: f64) -> (Distribution, Option<Summary>, bool) {
        let accuracy = self.query.accuracy;
        let mut goal = Goal {
            relative: FIRST_PART * accuracy,
            scale,
            floor: self.floor,
            negligible: 0.0,
            focus: Vec::new(),
            focus_relative: f64::INFINITY,
        };
        let faces = roots.len() as f64;
        goal.negligible = NEGLIGIBLE * goal.allowed(goal.scale) * self.total / faces;
        self.refine(&roots, &goal, FIRST_PIECES);
        drop(roots);
        let mut focused_rounds = 0;
        let mut doubt_before = f64::INFINITY;
        loop {
            let distribution = self.distribution();
            let Some(summary) = Summary::of(&distribution, self.wanted, self.largest) else {
                return (distribution, None, true);
            };
            let within = |(low, high): (f64, f64)| high - low <= accuracy * low + self.floor;
            let means_are_tight = within(summary.mean) && within(summary.rms);
            let doubt = self.doubt(&summary);
            let focus = self.focus(&summary);
            if self.shop.control.is_stopped() || means_are_tight && focus.is_empty() {
                let tight = means_are_tight && focus.is_empty();
                return (distribution, Some(summary), tight);
            }
            goal.scale = 0.5 * (summary.mean.0 + summary.mean.1);
            if means_are_tight {
                let stuck = doubt > LEAST_PROGRESS * doubt_before;
                if focused_rounds == FOCUSED_ROUNDS || stuck {
                    return (distribution, Some(summary), false);
                }
                doubt_before = doubt;
                let before = if focused_rounds == 0 { accuracy } else { goal.focus_relative };
                goal.focus_relative = FINER * before;
                goal.focus = focus;
                focused_rounds += 1;
            } else {
                goal.relative *= FINER;
                goal.negligible = NEGLIGIBLE * goal.allowed(goal.scale) * self.total / faces;
            }
            drop(distribution);
            let (open, good): (Vec<Piece>, Vec<Piece>) = std::mem::take(&mut self.made.pieces)
                .into_iter()
                .partition(|piece| goal.wanted(piece, self.shop.areas[piece.face as usize]).is_some());
            self.made.pieces = good;
            if open.is_empty() && goal.relative < f64::EPSILON {
                let distribution = self.distribution();
                let summary = Summary::of(&distribution, self.wanted, self.largest);
                return (distribution, summary, false);
            }
            self.refine(&open, &goal, LATER_PIECES);
        }
    }

    fn refine(&mut self, roots: &[Piece], goal: &Goal, most: usize) {
        self.rounds += 1;
        self.shop.refine(roots, goal, most, &mut self.made, &mut *self.watch);
    }

    fn distribution(&self) -> Distribution {
        let entry = |piece: &Piece| Entry {
            lower: piece.lower,
            upper: piece.upper,
            area: area_of(piece, self.areas[piece.face as usize]),
        };
        Distribution { entries: self.made.pieces.iter().map(entry).collect() }
    }

    /// Ranges of distances in which pieces keep a statistic from being as narrow as asked.
    fn focus(&self, summary: &Summary) -> Vec<(f64, f64)> {
        let accuracy = self.query.accuracy;
        let mut focus: Vec<(f64, f64)> = summary
            .percentiles
            .iter()
            .copied()
            .filter(|(low, high)| high - low > accuracy * low + self.floor)
            .collect();
        if let Some(((low, high), threshold)) = summary.above.zip(self.wanted.threshold)
            && high - low > accuracy
        {
            focus.push((threshold, threshold));
        }
        focus
    }

    /// Sum of the widths that are too great, each relative to what is allowed.
    fn doubt(&self, summary: &Summary) -> f64 {
        let accuracy = self.query.accuracy;
        let excess = |width: f64, allowed: f64| greater(width / allowed - 1.0, 0.0);
        let percentiles = summary.percentiles.iter();
        let of_percentiles: f64 =
            percentiles.map(|(low, high)| excess(high - low, accuracy * low + self.floor)).sum();
        of_percentiles + summary.above.map_or(0.0, |(low, high)| excess(high - low, accuracy))
    }
}
