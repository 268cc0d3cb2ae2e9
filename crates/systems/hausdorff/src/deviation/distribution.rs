//! How much of an area is how far away: sums over pieces, rounded outwards.

use super::linear::{
    Corners, PartUpTo, greater, greatest, least, lesser, mean_enclosure, mean_of_positive,
    mean_square_enclosure, mean_square_of_positive,
};
use super::polygon::Polygon;
use pompeiu_core::exact::Interval;
use rayon::prelude::*;

/// A triangle of a piece as statistics see it: the distance lies between two linear functions with these values at the corners. The one
/// above is given by how much greater it is; it and the area are stored so that they are not rounded the wrong way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    lower: Corners,
    width: [f32; 3],
    /// The area is at least this, and at most `more` greater.
    area: f64,
    more: f32,
}

impl Entry {
    /// A triangle of the fan of a polygon, of a face with an area in these bounds.
    pub(super) fn new(polygon: &Polygon, triangle: [usize; 3], (low, high): (f64, f64)) -> Self {
        let lower = triangle.map(|j| polygon.lower[j]);
        let upper = triangle.map(|j| polygon.upper[j]);
        let (share, error) = (polygon.share_of(triangle), polygon.share_error());
        let area = greater((share - error) * low * LESS, 0.0);
        let most = (share + error) * high * MORE + f64::MIN_POSITIVE;
        Self {
            lower,
            width: [0, 1, 2].map(|j| at_least(upper[j] - lower[j], upper[j])),
            area,
            more: at_least(most - area, most),
        }
    }

    pub(super) fn lower(&self) -> Corners {
        self.lower
    }

    /// The sum is rounded once, relative to itself, which the rounding of the width to fewer digits outweighs by far, or the step here.
    pub(super) fn upper(&self) -> Corners {
        [0, 1, 2].map(|j| (self.lower[j] + f64::from(self.width[j])).next_up())
    }

    /// The area from below and from above.
    pub(super) fn area(&self) -> (f64, f64) {
        (self.area, (self.area + f64::from(self.more)).next_up())
    }

    /// Area times mean width, rounded.
    pub(super) fn mass(&self) -> f64 {
        let width = |j: usize| {
            // As far as the function below is not negative.
            let cut = if self.lower[j] < 0.0 { self.lower[j] } else { 0.0 };
            f64::from(self.width[j]) + cut
        };
        self.area * (width(0) + width(1) + width(2)) * (1.0 / 3.0)
    }
}

/// A difference rounded up to fewer digits: at least the exact one, which is off by no more than the last digit of what it was
/// taken from.
fn at_least(difference: f64, from: f64) -> f32 {
    let wanted = difference + f64::EPSILON * (difference.abs() + from.abs());
    let rounded = wanted as f32;
    if f64::from(rounded) < wanted { rounded.next_up() } else { rounded }
}

/// The entries of the faces of one task, face by face.
#[derive(Clone, Debug, Default)]
pub(super) struct Portion {
    pub(super) entries: Vec<Entry>,
    /// Where those of each face start, and one end more.
    pub(super) starts: Vec<u32>,
}

impl Portion {
    /// The entries of one of the faces.
    pub(super) fn of_face(&self, face: usize) -> &[Entry] {
        &self.entries[self.starts[face] as usize..self.starts[face + 1] as usize]
    }
}

/// The pieces of one direction, or of both.
#[derive(Clone, Debug, Default)]
pub(super) struct Distribution {
    pub(super) portions: Vec<Portion>,
}

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

/// Encloses the mean of the distance over a piece.
pub(super) fn mean_of(lower: Corners, upper: Corners) -> (f64, f64) {
    (mean_of_positive(lower), mean_enclosure(upper).upper())
}

/// Values of a function at the corners of an entry, and the area that goes with it: that above, or that below.
type Weighted = (Corners, f64);

/// Which of the two functions between which the distance lies, with the area that makes it a bound.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    /// The function below, with areas from above: more area is at most so far.
    Lower,
    Upper,
}

impl Side {
    fn of(self, entry: &Entry) -> Weighted {
        match self {
            Self::Lower => (entry.lower(), entry.area().1),
            Self::Upper => (entry.upper(), entry.area().0),
        }
    }

    fn part(self, part: &PartUpTo, level: f64) -> f64 {
        match self {
            Self::Lower => part.above(level),
            Self::Upper => part.below(level),
        }
    }
}

/// A percentile that is looked for: the level at which an area is reached.
struct Crossing {
    side: Side,
    wanted: f64,
    low: f64,
    high: f64,
}

impl Distribution {
    /// Number of entries.
    pub(super) fn len(&self) -> usize {
        self.portions.iter().map(|portion| portion.entries.len()).sum()
    }

    /// Sums over all portions, each by itself and then in order.
    fn sum<S: Send>(&self, of: impl Fn(&[Entry]) -> S + Sync, plus: impl Fn(S, S) -> S, zero: S) -> S {
        let parts: Vec<S> =
            self.portions.par_iter().with_min_len(8).map(|portion| of(&portion.entries)).collect();
        parts.into_iter().fold(zero, plus)
    }

    pub(super) fn moments(&self) -> Moments {
        let of_portion = |entries: &[Entry]| {
            let mut sums = Moments::default();
            for entry in entries {
                let (low, high) = entry.area();
                let (lower, upper) = (entry.lower(), entry.upper());
                sums.area.add(low, high);
                let (below, above) = mean_of(lower, upper);
                sums.first.add(low * below * LESS, high * above * MORE);
                let above = mean_square_enclosure(upper).upper();
                sums.second.add(low * mean_square_of_positive(lower) * LESS, high * above * MORE);
            }
            sums
        };
        let plus = |a: Moments, b: Moments| Moments {
            area: a.area.plus(b.area),
            first: a.first.plus(b.first),
            second: a.second.plus(b.second),
        };
        self.sum(of_portion, plus, Moments::default())
    }

    /// Encloses the area whose distance is at most a level that is not negative.
    pub(super) fn area_up_to(&self, level: f64) -> Interval {
        let of_portion = |entries: &[Entry]| {
            let mut sum = Sum::default();
            for entry in entries {
                let (low, high) = entry.area();
                let below = PartUpTo::new(entry.upper()).below(level);
                let above = PartUpTo::new(entry.lower()).above(level);
                sum.add(low * below * LESS, high * above * MORE);
            }
            sum
        };
        self.sum(of_portion, Sum::plus, Sum::default()).enclosure()
    }

    /// Encloses for each share the least distance that so much of the area does not exceed, up to a part `fine` of itself.
    pub(super) fn percentiles(
        &self,
        shares: &[f64],
        area: Interval,
        largest: f64,
        fine: f64,
    ) -> Vec<(f64, f64)> {
        let samples = self.samples();
        let of_share = |share: &f64| {
            // Up to the first level less than the share lies for certain, up to the second not less.
            let range = samples.around(*share, largest);
            let crossing = |side, wanted| Crossing { side, wanted, low: range.0, high: range.1 };
            [
                crossing(Side::Lower, share * area.lower() * LESS),
                crossing(Side::Upper, share * area.upper() * MORE),
            ]
        };
        let crossings: Vec<Crossing> = shares.iter().flat_map(of_share).collect();
        let found: Vec<(f64, f64)> =
            crossings.par_iter().map(|crossing| self.crossing(crossing, largest, fine)).collect();
        found.chunks_exact(2).map(|ends| (ends[0].0, ends[1].1)).collect()
    }

    /// Some distances with areas, in ascending order.
    fn samples(&self) -> Samples {
        let stride = self.len() / SAMPLES + 1;
        let mut of_entries = Vec::new();
        for entry in self.portions.iter().flat_map(|portion| &portion.entries).step_by(stride) {
            let (low, high) = (entry.lower(), entry.upper());
            let middle = [0, 1, 2].map(|j| 0.5 * (low[j] + high[j]));
            let mean = super::linear::mean(middle);
            // At places inside the triangle that stand for a third of it each.
            of_entries.extend(middle.map(|x| (0.5 * (x + mean), entry.area)));
        }
        of_entries.sort_by(|a, b| a.0.total_cmp(&b.0));
        Samples(of_entries)
    }

    /// Two levels close to each other: up to the first, the parts of a function weighted with areas sum up to less than wanted, up to the
    /// second not. Rounding makes the sums greater for the function below, lesser for the one above.
    fn crossing(&self, crossing: &Crossing, largest: f64, fine: f64) -> (f64, f64) {
        let Crossing { side, wanted, .. } = *crossing;
        let (mut low, mut high) = (crossing.low, crossing.high);
        let slack = (self.len() + 16) as f64 * f64::EPSILON * 4.0;
        let reaches = |sum: f64| match side {
            Side::Lower => sum * (1.0 + slack) >= wanted,
            Side::Upper => sum * (1.0 - slack) >= wanted,
        };
        let (mut below, mut active);
        loop {
            (below, active) = self.between(side, low, high);
            let sum_at = |level: f64| below + sum_up_to(side, &active, level);
            // Outside of zero and the largest distance is nothing to be found.
            let (from_start, to_end) = (low <= 0.0, high >= largest);
            let (bad_low, bad_high) =
                (!from_start && reaches(sum_at(low)), !to_end && !reaches(sum_at(high)));
            if !bad_low && !bad_high {
                break;
            }
            let width = high - low;
            low = if bad_low { greater(low - 4.0 * width, 0.0) } else { low };
            high = if bad_high { lesser(high + 4.0 * width + MORE - 1.0, largest) } else { high };
            if bad_low && low < 0.5 * width {
                low = 0.0;
            }
        }
        let (mut at_low, mut at_high) = (below, below + active.iter().map(|(_, weight)| weight).sum::<f64>());
        let mut probe = 0;
        for _ in 0..PROBES {
            let width = high - low;
            if width <= fine * high {
                break;
            }
            // Beside where a straight line would reach the area, on one side and on the other; or in the middle.
            let there = low + width * ((wanted - at_low) / (at_high - at_low));
            let level = match probe {
                0 => there - CLOSE * width,
                1 => there + CLOSE * width,
                _ => 0.5 * (low + high),
            };
            let level = if level > low && level < high { level } else { 0.5 * (low + high) };
            if level <= low || level >= high {
                break;
            }
            let sum = below + sum_up_to(side, &active, level);
            let reached = reaches(sum);
            probe = match (probe, reached) {
                (0, false) => 1,
                (1, true) | (2, _) => 0,
                _ => 2,
            };
            if reached {
                (high, at_high) = (level, sum);
                active.retain(|(part, _)| part.least() <= level);
            } else {
                (low, at_low) = (level, sum);
                active.retain(|(part, weight)| {
                    let inside = part.greatest() > level;
                    if !inside {
                        below += weight;
                    }
                    inside
                });
            }
        }
        (low, high)
    }

    /// The area of the entries that lie below a range wholly, and the entries that reach into it.
    fn between(&self, side: Side, low: f64, high: f64) -> (f64, Vec<(PartUpTo, f64)>) {
        let (mut below, mut active) = (0.0, Vec::new());
        for entry in self.portions.iter().flat_map(|portion| &portion.entries) {
            let (v, weight) = side.of(entry);
            if greatest(v) <= low {
                below += weight;
            } else if least(v) <= high {
                active.push((PartUpTo::new(v), weight));
            }
        }
        (below, active)
    }

    /// Encloses the areas up to each of the levels `largest * k / bins`, `k` from 0 to `bins`.
    pub(super) fn cumulative(&self, largest: f64, bins: usize) -> Vec<Interval> {
        let levels: Vec<f64> = (0..=bins).map(|k| level(largest, k, bins)).collect();
        let of_entries = |portions: &[Portion]| {
            let mut sums = vec![Sum::default(); bins + 1];
            let mut all_from = vec![Sum::default(); bins + 2];
            for entry in portions.iter().flat_map(|portion| &portion.entries) {
                let (low, high) = entry.area();
                let (lower, upper) = (entry.lower(), entry.upper());
                // From the first level that reaches into the piece to the first above it.
                let from = least(lower);
                let first = levels.partition_point(|t| *t < from);
                let to = greatest(upper);
                let last = first + levels[first..].partition_point(|t| *t < to);
                if first < last {
                    let (lower, upper) = (PartUpTo::new(lower), PartUpTo::new(upper));
                    for (sum, level) in sums[first..last].iter_mut().zip(&levels[first..last]) {
                        sum.add(low * upper.below(*level) * LESS, high * lower.above(*level) * MORE);
                    }
                }
                all_from[last.min(bins + 1)].add(low, high);
            }
            let mut all = Sum::default();
            for (sum, from) in sums.iter_mut().zip(&all_from) {
                all = all.plus(*from);
                *sum = sum.plus(all);
            }
            sums
        };
        let chunks: Vec<Vec<Sum>> = self.portions.par_chunks(PORTIONS).map(of_entries).collect();
        let mut total = vec![Sum::default(); bins + 1];
        for chunk in chunks {
            for (sum, more) in total.iter_mut().zip(chunk) {
                *sum = sum.plus(more);
            }
        }
        total.iter().map(Sum::enclosure).collect()
    }
}

/// Distances with areas, in ascending order: where to look for a percentile.
struct Samples(Vec<(f64, f64)>);

impl Samples {
    /// A range in which the percentile of a share is likely to lie.
    fn around(&self, share: f64, largest: f64) -> (f64, f64) {
        let total: f64 = self.0.iter().map(|(_, area)| area).sum();
        let at = |part: f64| {
            let mut sum = 0.0;
            self.0.iter().find(|(_, area)| {
                sum += area;
                sum >= part * total
            })
        };
        let low = if share > DOUBT { at(share - DOUBT).map_or(0.0, |(x, _)| *x) } else { 0.0 };
        let high = if share < 1.0 - DOUBT { at(share + DOUBT).map_or(largest, |(x, _)| *x) } else { largest };
        let low = greater(low, 0.0);
        (lesser(low, largest), lesser(if high > low { high } else { low * MORE }, largest))
    }
}

fn sum_up_to(side: Side, active: &[(PartUpTo, f64)], level: f64) -> f64 {
    active.iter().map(|(part, weight)| weight * side.part(part, level)).sum()
}

/// The edge between bins.
pub(super) fn level(largest: f64, k: usize, bins: usize) -> f64 {
    if k == bins { largest } else { lesser(largest * (k as f64 / bins as f64), largest) }
}

/// Factors that outweigh the rounding of a few products.
const MORE: f64 = 1.0 + 8.0 * f64::EPSILON;
const LESS: f64 = 1.0 - 8.0 * f64::EPSILON;
/// Portions summed at a time; fixed, so that sums do not depend on the number of threads.
const PORTIONS: usize = 16;
/// Entries that are sampled, about.
const SAMPLES: usize = 4096;
/// How far the share of the samples up to a level may be from that of all, most of the time.
const DOUBT: f64 = 0.03;
/// Levels that are tried at most for a percentile.
const PROBES: usize = 120;
/// How far beside the level that is expected, as a part of the range.
const CLOSE: f64 = 0.02;
