//! How much of an area is how far away: sums over pieces, rounded outwards.

use super::envelope::Piece;
use super::linear::{
    Corners, greater, greatest, least, lesser, mean_enclosure, mean_of_positive, mean_square_enclosure,
    mean_square_of_positive, part_up_to,
};
use pompeiu_core::exact::Interval;
use rayon::prelude::*;

/// A piece as statistics see it: distances in the unit of the meshes, and its area, which may be in any unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) lower: Corners,
    pub(super) upper: Corners,
    pub(super) area: (f64, f64),
}

/// The pieces of one direction, or of both.
#[derive(Clone, Debug, Default)]
pub(super) struct Distribution {
    pub(super) entries: Vec<Entry>,
}

/// Entries summed at a time; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 1 << 12;
/// Halvings of the range in which a percentile lies: to the last digit, nearly.
const HALVINGS: usize = 50;
/// Levels at which a range is looked up before it is halved.
const COARSE: usize = 256;

/// A sum of numbers that are not negative, from below and from above.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    lower: f64,
    upper: f64,
    terms: f64,
}

impl Sum {
    pub(super) fn add(&mut self, lower: f64, upper: f64) {
        self.lower += lower;
        self.upper += upper;
        self.terms += 1.0;
    }

    fn plus(mut self, other: Self) -> Self {
        self.lower += other.lower;
        self.upper += other.upper;
        self.terms += other.terms + 1.0;
        self
    }

    /// Encloses the sum: adding `n` numbers of one sign is off by at most `n` roundings of the result.
    pub(super) fn enclosure(&self) -> Interval {
        let slack = (self.terms + 2.0) * f64::EPSILON;
        Interval::spanning(greater(self.lower * (1.0 - slack), 0.0), self.upper * (1.0 + slack))
    }
}

/// Sums that means are made of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    pub(super) area: Sum,
    pub(super) first: Sum,
    pub(super) second: Sum,
}

/// The area of a piece, rounded outwards, of a face with an area in these bounds: shares are rounded a few times for each cut.
pub(super) fn area_of(piece: &Piece, (low, high): (f64, f64)) -> (f64, f64) {
    let slack = (4.0 * f64::from(piece.depth) + 8.0) * f64::EPSILON;
    (low * piece.share * (1.0 - slack), high * piece.share * (1.0 + slack) + f64::MIN_POSITIVE)
}

/// Encloses the mean of the distance over a piece.
pub(super) fn mean_of(lower: Corners, upper: Corners) -> (f64, f64) {
    (mean_of_positive(lower), mean_enclosure(upper).upper())
}

impl Distribution {
    pub(super) fn moments(&self) -> Moments {
        let of_chunk = |entries: &[Entry]| {
            let mut sums = Moments::default();
            for Entry { lower, upper, area: (low, high) } in entries {
                sums.area.add(*low, *high);
                let (below, above) = mean_of(*lower, *upper);
                sums.first.add(low * below * LESS, high * above * MORE);
                let above = mean_square_enclosure(*upper).upper();
                sums.second.add(low * mean_square_of_positive(*lower) * LESS, high * above * MORE);
            }
            sums
        };
        let chunks: Vec<Moments> = self.entries.par_chunks(CHUNK).map(of_chunk).collect();
        chunks.into_iter().fold(Moments::default(), |a, b| Moments {
            area: a.area.plus(b.area),
            first: a.first.plus(b.first),
            second: a.second.plus(b.second),
        })
    }

    /// Encloses the area whose distance is at most a level that is not negative.
    pub(super) fn area_up_to(&self, level: f64) -> Interval {
        let of_chunk = |entries: &[Entry]| {
            let mut sum = Sum::default();
            for Entry { lower, upper, area: (low, high) } in entries {
                sum.add(
                    low * part_up_to(*upper, level).lower() * LESS,
                    high * part_up_to(*lower, level).upper() * MORE,
                );
            }
            sum
        };
        let chunks: Vec<Sum> = self.entries.par_chunks(CHUNK).map(of_chunk).collect();
        chunks.into_iter().fold(Sum::default(), Sum::plus).enclosure()
    }

    /// Encloses for each share the least distance that so much of the area does not exceed.
    pub(super) fn percentiles(&self, shares: &[f64], area: Interval, largest: f64) -> Vec<(f64, f64)> {
        let coarse = self.cumulative(largest, COARSE);
        let of_share = |share: &f64| {
            // Up to the first level less than the share lies for certain, up to the second not less.
            let (less, enough) = (share * area.lower() * LESS, share * area.upper() * MORE);
            let low = coarse.partition_point(|up_to| up_to.upper() < less).saturating_sub(1);
            let high = coarse.partition_point(|up_to| up_to.lower() < enough).min(COARSE);
            let range = |k: usize| (level(largest, k, COARSE), level(largest, (k + 1).min(COARSE), COARSE));
            let low = self.crossing(|e| (e.lower, e.area.1), less, MORE, range(low)).0;
            let high = self.crossing(|e| (e.upper, e.area.0), enough, LESS, range(high.saturating_sub(1))).1;
            (low, high)
        };
        shares.par_iter().map(of_share).collect()
    }

    /// Two neighbouring levels in a range, or its ends: up to the first, the parts of functions weighted with areas sum up to less
    /// than `wanted`, up to the second not. The sums are rounded towards `direction`. Of the ends of the range that must be known.
    fn crossing(
        &self,
        function: impl Fn(&Entry) -> (Corners, f64),
        wanted: f64,
        direction: f64,
        (mut low, mut high): (f64, f64),
    ) -> (f64, f64) {
        let count = self.entries.len();
        let rounded = |sum: f64| sum * (1.0 + (direction - 1.0) * (count + 16) as f64);
        // Of the entries that lie below the range wholly.
        let mut below = 0.0;
        let mut active: Vec<(Corners, f64)> = Vec::new();
        for (v, weight) in self.entries.iter().map(function) {
            if greatest(v) <= low {
                below += weight;
            } else if least(v) <= high {
                active.push((v, weight));
            }
        }
        for _ in 0..HALVINGS {
            let level = 0.5 * (low + high);
            let mut sum = below;
            for (v, weight) in &active {
                let part = part_up_to(*v, level);
                sum += weight * if direction > 1.0 { part.upper() } else { part.lower() };
            }
            if rounded(sum) < wanted {
                low = level;
                active.retain(|(v, weight)| {
                    let inside = greatest(*v) > level;
                    if !inside {
                        below += weight;
                    }
                    inside
                });
            } else {
                high = level;
                active.retain(|(v, _)| least(*v) <= level);
            }
        }
        (low, high)
    }

    /// Encloses the areas up to each of the levels `largest * k / bins`, `k` from 0 to `bins`.
    pub(super) fn cumulative(&self, largest: f64, bins: usize) -> Vec<Interval> {
        let levels: Vec<f64> = (0..=bins).map(|k| level(largest, k, bins)).collect();
        let of_chunk = |entries: &[Entry]| {
            let mut sums = vec![Sum::default(); bins + 1];
            let mut all_from = vec![Sum::default(); bins + 2];
            for Entry { lower, upper, area: (low, high) } in entries {
                // From the first level that reaches into the piece to the first above it.
                let first = levels.partition_point(|t| *t < least(*lower));
                let last = levels.partition_point(|t| *t < greatest(*upper));
                for k in first..last.min(bins + 1) {
                    sums[k].add(
                        low * part_up_to(*upper, levels[k]).lower() * LESS,
                        high * part_up_to(*lower, levels[k]).upper() * MORE,
                    );
                }
                all_from[last.min(bins + 1)].add(*low, *high);
            }
            let mut all = Sum::default();
            for (sum, from) in sums.iter_mut().zip(&all_from) {
                all = all.plus(*from);
                *sum = sum.plus(all);
            }
            sums
        };
        let chunks: Vec<Vec<Sum>> = self.entries.par_chunks(CHUNK).map(of_chunk).collect();
        let mut total = vec![Sum::default(); bins + 1];
        for chunk in chunks {
            for (sum, more) in total.iter_mut().zip(chunk) {
                *sum = sum.plus(more);
            }
        }
        total.iter().map(Sum::enclosure).collect()
    }
}

/// The edge between bins.
pub(super) fn level(largest: f64, k: usize, bins: usize) -> f64 {
    if k == bins { largest } else { lesser(largest * (k as f64 / bins as f64), largest) }
}

/// Factors that outweigh the rounding of a few products.
const MORE: f64 = 1.0 + 8.0 * f64::EPSILON;
const LESS: f64 = 1.0 - 8.0 * f64::EPSILON;
