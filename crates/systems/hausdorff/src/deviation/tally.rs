//! Areas up to many levels at a time, for the function above the distance and for the one below it.

use super::distribution::{Distribution, PORTIONS};
use super::entry::Entry;
use super::linear::{Corners, PartUpTo, greater, greatest, least, lesser};
use super::portion::Portion;
use rayon::prelude::*;

/// Levels of a scale.
pub(super) const LEVELS: usize = 32;
/// Where the ends of a range differ by more than this factor, levels are this factor's root apart, and not equally far.
const WIDE_RANGE: f64 = 64.0;
const STEP: f64 = 0.125;

/// Values of a function at the corners of an entry, and the area that goes with it: that above, or that below.
pub(super) type Weighted = (Corners, f64);

/// Which of the two functions between which the distance lies, with the area that makes it a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    /// The function below, with areas from above: more area is at most so far.
    Lower,
    Upper,
}

impl Side {
    pub(super) fn of(self, entry: &Entry) -> Weighted {
        match self {
            Self::Lower => (entry.lower(), entry.area().1),
            Self::Upper => (entry.upper(), entry.area().0),
        }
    }

    /// Whether a sum over so many entries, exactly summed up, may be as great as wanted, or must be.
    pub(super) fn reaches(self, sum: f64, wanted: f64, entries: usize) -> bool {
        let slack = (entries + 16) as f64 * f64::EPSILON * 4.0;
        match self {
            Self::Lower => sum * (1.0 + slack) >= wanted,
            Self::Upper => sum * (1.0 - slack) >= wanted,
        }
    }
}

/// The least and the greatest value of both functions on a portion.
pub(super) type Ranges = [(f64, f64); 2];

/// Both functions, and their places among two.
const SIDES: [(Side, usize); 2] = [(Side::Lower, 0), (Side::Upper, 1)];

/// Levels in ascending order, at which areas are summed up together.
#[derive(Clone, Copy)]
pub(super) struct Scale(pub(super) [f64; LEVELS]);

/// The areas up to the levels of a scale: those of all entries that lie below it, and the parts of others.
#[derive(Clone, Copy)]
pub(super) struct Tally {
    pub(super) below: f64,
    pub(super) sums: [f64; LEVELS],
}

impl Distribution {
    /// Areas up to the levels of some scales, for the function below and for the one above. `ranges` are those of all portions or of
    /// none, and then found.
    pub(super) fn tallies(&self, scales: &[Vec<Scale>; 2], ranges: &mut Vec<Ranges>) -> [Vec<Tally>; 2] {
        let new = || scales.each_ref().map(|scales| vec![Tally::default(); scales.len()]);
        let of_entries = |(chunk, portions): (usize, &[Portion])| {
            let known = ranges.get(chunk * PORTIONS..).unwrap_or_default();
            let mut tallies = new();
            let mut found = Vec::new();
            for (i, portion) in portions.iter().enumerate() {
                if known.get(i).is_some_and(|ranges| take_whole(portion, ranges, scales, &mut tallies)) {
                    continue;
                }
                let mut range = [(f64::INFINITY, f64::NEG_INFINITY); 2];
                // Not a loop: iterators of two parts are quicker from within.
                portion.entries.iter().for_each(|entry| {
                    for (side, k) in SIDES {
                        let (v, weight) = side.of(&entry);
                        let (from, to) = (least(v), greatest(v));
                        range[k] = (lesser(range[k].0, from), greater(range[k].1, to));
                        let mut part = None;
                        for (scale, tally) in scales[k].iter().zip(&mut tallies[k]) {
                            if scale.is_above(to) {
                                tally.below += weight;
                            } else if !scale.is_below(from) {
                                let part = part.get_or_insert_with(|| PartUpTo::new(v));
                                part.add(side == Side::Lower, weight, &scale.0, &mut tally.sums);
                            }
                        }
                    }
                });
                found.push(range);
            }
            (tallies, found)
        };
        let chunks: Vec<([Vec<Tally>; 2], Vec<Ranges>)> =
            self.portions.par_chunks(PORTIONS).enumerate().map(of_entries).collect();
        let mut total = new();
        let none_were_known = ranges.is_empty();
        for (chunk, found) in chunks {
            for (sum, more) in total.iter_mut().flatten().zip(chunk.iter().flatten()) {
                sum.below += more.below;
                for (x, y) in sum.sums.iter_mut().zip(more.sums) {
                    *x += y;
                }
            }
            if none_were_known {
                ranges.extend(found);
            }
        }
        total
    }
}

/// Counts a portion as a whole, if no scale has a level between its values.
fn take_whole(
    portion: &Portion,
    ranges: &Ranges,
    scales: &[Vec<Scale>; 2],
    tallies: &mut [Vec<Tally>; 2],
) -> bool {
    let is_apart = |k: usize| {
        let (from, to) = ranges[k];
        scales[k].iter().all(|scale| scale.is_above(to) || scale.is_below(from))
    };
    if !(is_apart(0) && is_apart(1)) {
        return false;
    }
    let area = portion.moments.area.enclosure();
    for ((side, k), tallies) in SIDES.into_iter().zip(tallies) {
        let weight = if side == Side::Lower { area.upper() } else { area.lower() };
        for (scale, tally) in scales[k].iter().zip(tallies) {
            tally.below += if scale.is_above(ranges[k].1) { weight } else { 0.0 };
        }
    }
    true
}

impl Scale {
    /// Whether all levels are at least so high.
    fn is_above(&self, to: f64) -> bool {
        to <= self.0[0]
    }

    /// Whether all levels are below.
    fn is_below(&self, from: f64) -> bool {
        from > self.0[LEVELS - 1]
    }

    /// Levels close to each other, up to the largest distance.
    pub(super) fn around(level: f64, fine: f64, largest: f64) -> Self {
        let at = |i: usize| level * (1.0 + 0.9 * fine * (i as f64 - 0.5 * (LEVELS - 1) as f64));
        Self(std::array::from_fn(|i| lesser(at(i), largest)))
    }

    /// Levels from one to another.
    pub(super) fn between(low: f64, high: f64) -> Self {
        let mut levels = [high; LEVELS];
        if high > WIDE_RANGE * low {
            for i in (1..LEVELS - 1).rev() {
                levels[i] = greater(levels[i + 1] * STEP, low);
            }
        } else {
            let step = (high - low) / (LEVELS - 1) as f64;
            for (i, level) in levels.iter_mut().enumerate().take(LEVELS - 1) {
                *level = lesser(low + i as f64 * step, high);
            }
        }
        levels[0] = low;
        Self(levels)
    }
}

impl Default for Tally {
    fn default() -> Self {
        Self { below: 0.0, sums: [0.0; LEVELS] }
    }
}
