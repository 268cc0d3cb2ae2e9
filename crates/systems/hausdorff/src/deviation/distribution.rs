//! How much of an area is up to how far away.

use super::entry::{Entry, LESS, MORE, Moments, Sum};
use super::linear::{PartUpTo, greatest, least, lesser};
use super::packed::Entries;
use super::portion::Portion;
use pompeiu_core::exact::Interval;
use rayon::prelude::*;

/// Portions summed at a time; fixed, so that sums do not depend on the number of threads.
pub(super) const PORTIONS: usize = 16;
/// Ends of bins at which areas are summed up together.
const TOGETHER: usize = 8;

/// The pieces of one direction, or of both.
#[derive(Clone, Debug, Default)]
pub(super) struct Distribution {
    pub(super) portions: Vec<Portion>,
}

impl Distribution {
    /// Number of entries.
    pub(super) fn len(&self) -> usize {
        self.portions.iter().map(|portion| portion.entries.len()).sum()
    }

    /// Bytes that entries take.
    pub(super) fn bytes(&self) -> usize {
        self.portions.iter().map(|portion| portion.entries.bytes()).sum()
    }

    /// Sums over all portions, each by itself and then in order.
    fn sum<S: Send>(&self, of: impl Fn(&Entries) -> S + Sync, plus: impl Fn(S, S) -> S, zero: S) -> S {
        let parts: Vec<S> =
            self.portions.par_iter().with_min_len(8).map(|portion| of(&portion.entries)).collect();
        parts.into_iter().fold(zero, plus)
    }
}

impl Measured for Distribution {
    fn moments(&self) -> Moments {
        self.portions.iter().map(|portion| portion.moments).fold(Moments::default(), Moments::plus)
    }

    fn percentiles(&self, shares: &[f64], area: Interval, largest: f64, fine: f64) -> Vec<(f64, f64)> {
        self.enclosed_percentiles(shares, area, largest, fine)
    }

    fn area_up_to(&self, level: f64) -> Interval {
        let of_portion = |entries: &Entries| {
            let mut sum = Sum::default();
            entries.iter().for_each(|entry| add_part_up_to(&mut sum, &entry, level));
            sum
        };
        self.sum(of_portion, Sum::plus, Sum::default()).enclosure()
    }

    fn cumulative(&self, largest: f64, bins: usize) -> Vec<Sum> {
        if bins == 0 {
            return Vec::new();
        }
        // Levels are looked at several at a time; those that fill the last ones up are beyond all distances.
        let mut levels: Vec<f64> = (0..=bins).map(|k| level(largest, k, bins)).collect();
        let per_length = bins as f64 / largest;
        levels.resize(bins + 1 + TOGETHER, f64::INFINITY);
        let of_entries = |portions: &[Portion]| {
            let [mut below, mut above] = [vec![0.0; levels.len()], vec![0.0; levels.len()]];
            let mut all_from = vec![Sum::default(); levels.len()];
            let mut entries = 0.0;
            // Not a loop: iterators of two parts are quicker from within.
            portions.iter().flat_map(|portion| portion.entries.iter()).for_each(|entry| {
                entries += 1.0;
                let (low, high) = entry.area();
                let (lower, upper) = (entry.lower(), entry.upper());
                // From the first level that reaches into the piece to the first above it.
                let mut first = first_not_below(&levels[..=bins], least(lower), per_length);
                let last = first_not_below(&levels[..=bins], greatest(upper), per_length);
                if first < last {
                    let (lower, upper) = (PartUpTo::new(lower), PartUpTo::new(upper));
                    while first < last {
                        let range = first..first + TOGETHER;
                        let some: &[f64; TOGETHER] =
                            levels[range.clone()].first_chunk().expect("there is room");
                        let sums = below[range.clone()].first_chunk_mut().expect("there is room");
                        upper.add(false, low, some, sums);
                        let sums = above[range].first_chunk_mut().expect("there is room");
                        lower.add(true, high, some, sums);
                        first += TOGETHER;
                    }
                    all_from[first.min(bins + 1)].add(low, high);
                } else {
                    all_from[last].add(low, high);
                }
            });
            let mut all = Sum::default();
            let sum_of = |k: usize| {
                all = all.plus(all_from[k]);
                Sum::of(below[k], above[k], entries).plus(all)
            };
            (0..=bins).map(sum_of).collect::<Vec<Sum>>()
        };
        let chunks: Vec<Vec<Sum>> = self.portions.par_chunks(PORTIONS).map(of_entries).collect();
        let mut total = vec![Sum::default(); bins + 1];
        for chunk in chunks {
            for (sum, more) in total.iter_mut().zip(chunk) {
                *sum = sum.plus(more);
            }
        }
        total
    }
}

/// Adds the area of an entry whose distance is at most a level.
pub(super) fn add_part_up_to(sum: &mut Sum, entry: &Entry, level: f64) {
    let (low, high) = entry.area();
    let below = PartUpTo::new(entry.upper()).below(level);
    let above = PartUpTo::new(entry.lower()).above(level);
    sum.add(low * below * LESS, high * above * MORE);
}

/// The first of some levels at equal distances that is not below a value.
fn first_not_below(levels: &[f64], value: f64, per_length: f64) -> usize {
    // Casting saturates, and takes what is no number for zero.
    let mut first = ((value * per_length) as usize).min(levels.len());
    while first > 0 && levels[first - 1] >= value {
        first -= 1;
    }
    while first < levels.len() && levels[first] < value {
        first += 1;
    }
    first
}

/// The edge between bins.
pub(super) fn level(largest: f64, k: usize, bins: usize) -> f64 {
    if k == bins { largest } else { lesser(largest * (k as f64 / bins as f64), largest) }
}

/// An area of which is known how much of it is up to how far away.
pub(super) trait Measured {
    fn moments(&self) -> Moments;

    /// Encloses for each share the least distance that so much of the area does not exceed, up to a part `fine` of itself, or as fine as it goes.
    fn percentiles(&self, shares: &[f64], area: Interval, largest: f64, fine: f64) -> Vec<(f64, f64)>;

    /// Encloses the area whose distance is at most a level that is not negative.
    fn area_up_to(&self, level: f64) -> Interval;

    /// The areas up to each of the levels `largest * k / bins`, `k` from 0 to `bins`; of no bins, none.
    fn cumulative(&self, largest: f64, bins: usize) -> Vec<Sum>;
}
