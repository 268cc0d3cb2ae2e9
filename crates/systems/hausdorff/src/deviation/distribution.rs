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
        let [i, j, k] = triangle;
        let (low_at, width) =
            (&polygon.lower, |j: usize| at_least(polygon.upper[j] - polygon.lower[j], polygon.upper[j]));
        let (share, error) = (polygon.outline.share_of(triangle), polygon.outline.share_error());
        let area = greater((share - error) * low * LESS, 0.0);
        let most = (share + error) * high * MORE + f64::MIN_POSITIVE;
        Self {
            lower: [low_at[i], low_at[j], low_at[k]],
            width: [width(i), width(j), width(k)],
            area,
            more: at_least(most - area, most),
        }
    }

    pub(super) fn lower(&self) -> Corners {
        self.lower
    }

    /// The sum is rounded once, relative to itself, which the rounding of the width to fewer digits outweighs by far, or the step here.
    pub(super) fn upper(&self) -> Corners {
        let at = |j: usize| (self.lower[j] + f64::from(self.width[j])).next_up();
        [at(0), at(1), at(2)]
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
    /// Of all of them.
    pub(super) moments: Moments,
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

    pub(super) fn plus(mut self, other: Self) -> Self {
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

impl Moments {
    pub(super) fn of(entries: &[Entry]) -> Self {
        let mut sums = Self::default();
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
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            area: self.area.plus(other.area),
            first: self.first.plus(other.first),
            second: self.second.plus(other.second),
        }
    }
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

    /// Whether a sum over so many entries, exactly summed up, may be as great as wanted, or must be.
    fn reaches(self, sum: f64, wanted: f64, entries: usize) -> bool {
        let slack = (entries + 16) as f64 * f64::EPSILON * 4.0;
        match self {
            Self::Lower => sum * (1.0 + slack) >= wanted,
            Self::Upper => sum * (1.0 - slack) >= wanted,
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
    /// No more area lies between; infinite where that is not known.
    between: f64,
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
        self.portions.iter().map(|portion| portion.moments).fold(Moments::default(), Moments::plus)
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
        let fine = lesser(fine, COARSEST);
        let entries = self.len();
        let [lower, upper] = self.forecasts(largest).map(|forecast| forecast.levels(shares));
        let around = |(lower, upper)| [Scale::around(lower, fine), Scale::around(upper, fine)];
        let scales: Vec<[Scale; 2]> = lower.into_iter().zip(upper).map(around).collect();
        let tallies = self.tallies(&scales);
        let crossings: Vec<Crossing> = shares
            .iter()
            .zip(&scales)
            .zip(&tallies)
            .flat_map(|((share, scales), [lower, upper])| {
                // Up to the first level less than the share lies for certain, up to the second not less.
                let of_side = |side, wanted, tally: &Tally, scale| {
                    let (low, high, between) = tally.crossing(side, wanted, scale, entries);
                    let (low, high) = (lesser(low, largest), lesser(high, largest));
                    Crossing { side, wanted, low, high, between }
                };
                [
                    of_side(Side::Lower, share * area.lower() * LESS, lower, &scales[0]),
                    of_side(Side::Upper, share * area.upper() * MORE, upper, &scales[1]),
                ]
            })
            .collect();
        let of_crossing = |crossing: &Crossing| {
            let found = self.crossing(crossing, largest, fine);
            // Rounding of the sums does not matter: this steers only how narrow the ends are.
            let is_settled =
                found == (crossing.low, crossing.high) && crossing.between < LUMP * crossing.wanted;
            if is_settled { found } else { self.moved_to_values(crossing, found) }
        };
        let found: Vec<(f64, f64)> = crossings.par_iter().map(of_crossing).collect();
        found.chunks_exact(2).map(|ends| (ends[0].0, ends[1].1)).collect()
    }

    /// About how much area is how far away as both functions say: of some entries, if there are many.
    fn forecasts(&self, largest: f64) -> [Forecast; 2] {
        let step = (self.len() / FORECAST).max(1);
        let new = || [Forecast::new(largest), Forecast::new(largest)];
        let of_entries = |portions: &[Portion]| {
            let [mut lower, mut upper] = new();
            for entry in portions.iter().flat_map(|portion| &portion.entries).step_by(step) {
                lower.add(entry.lower(), entry.area);
                upper.add(entry.upper(), entry.area);
            }
            [lower, upper]
        };
        let plus = |[a, b]: [Forecast; 2], [c, d]: &[Forecast; 2]| [a.plus(c), b.plus(d)];
        // Fewer and larger chunks: each takes memory of its own.
        let chunks: Vec<[Forecast; 2]> = self.portions.par_chunks(8 * PORTIONS).map(of_entries).collect();
        chunks.iter().fold(new(), plus)
    }

    /// Areas up to some levels, for both functions.
    fn tallies(&self, scales: &[[Scale; 2]]) -> Vec<[Tally; 2]> {
        let of_entries = |portions: &[Portion]| {
            let mut tallies = vec![[Tally::default(); 2]; scales.len()];
            for entry in portions.iter().flat_map(|portion| &portion.entries) {
                for (side, k) in [(Side::Lower, 0), (Side::Upper, 1)] {
                    let (v, weight) = side.of(entry);
                    let (from, to) = (least(v), greatest(v));
                    let mut part = None;
                    for (scale, tally) in scales.iter().zip(&mut tallies) {
                        let (scale, tally) = (&scale[k], &mut tally[k]);
                        if to <= scale.0[0] {
                            tally.below += weight;
                        } else if from <= scale.0[LEVELS - 1] {
                            let part = part.get_or_insert_with(|| PartUpTo::new(v));
                            tally.add(side, part, weight, scale);
                        }
                    }
                }
            }
            tallies
        };
        let chunks: Vec<Vec<[Tally; 2]>> = self.portions.par_chunks(PORTIONS).map(of_entries).collect();
        let mut total = vec![[Tally::default(); 2]; scales.len()];
        for chunk in chunks {
            for (sum, more) in total.iter_mut().flatten().zip(chunk.iter().flatten()) {
                sum.below += more.below;
                for (x, y) in sum.sums.iter_mut().zip(more.sums) {
                    *x += y;
                }
            }
        }
        total
    }

    /// Two levels close to each other: up to the first, the parts of a function weighted with areas sum up to less than wanted, up to the
    /// second not. Rounding makes the sums greater for the function below, lesser for the one above.
    fn crossing(&self, crossing: &Crossing, largest: f64, fine: f64) -> (f64, f64) {
        let Crossing { side, wanted, .. } = *crossing;
        let (mut low, mut high) = (crossing.low, crossing.high);
        if low < high && high - low <= fine * high {
            return (low, high);
        }
        let entries = self.len();
        let reaches = |sum: f64| side.reaches(sum, wanted, entries);
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

    /// Two levels moved towards each other, to the next values of entries, if much area lies between them and no entry reaches over
    /// one: from there to the next value sums stay the same.
    fn moved_to_values(&self, crossing: &Crossing, (low, high): (f64, f64)) -> (f64, f64) {
        let Crossing { side, wanted, .. } = *crossing;
        let entries =
            || self.portions.iter().flat_map(|portion| &portion.entries).map(|entry| side.of(entry));
        let within = |(v, _): &Weighted| least(*v) > low && greatest(*v) <= high;
        if entries().filter(within).map(|(_, weight)| weight).sum::<f64>() < LUMP * wanted {
            return (low, high);
        }
        let (_, active) = self.between(side, low, high);
        let crosses =
            |level: f64| active.iter().any(|(part, _)| part.least() <= level && level < part.greatest());
        let next = active.iter().map(|(part, _)| part.least()).filter(|x| *x > low).fold(high, lesser);
        let last = active.iter().map(|(part, _)| part.greatest()).filter(|x| *x <= high).fold(low, greater);
        (if crosses(low) { low } else { next }, if crosses(high) { high } else { last })
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

    /// The areas up to each of the levels `largest * k / bins`, `k` from 0 to `bins`; of no bins, none.
    pub(super) fn cumulative(&self, largest: f64, bins: usize) -> Vec<Sum> {
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
            for entry in portions.iter().flat_map(|portion| &portion.entries) {
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
            }
            let mut all = Sum::default();
            let sum_of = |k: usize| {
                all = all.plus(all_from[k]);
                Sum { lower: below[k], upper: above[k], terms: entries }.plus(all)
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

/// About how much area is up to how far away: where to look for percentiles.
///
/// How the area of a triangle with a linear function is distributed over its values is a piecewise linear density with three
/// corners. Where these corners are, and how much the slope changes there, is summed up on a grid.
struct Forecast {
    per_length: f64,
    /// Changes of slope at the places of the grid.
    bends: Vec<f64>,
    /// Areas that lie at a place as far as the grid can tell.
    lumps: Vec<f64>,
}

impl Forecast {
    const PLACES: usize = 4096;

    fn new(largest: f64) -> Self {
        // One more at each end, for what reaches over it.
        let zero = vec![0.0; Self::PLACES + 4];
        Self { per_length: Self::PLACES as f64 / largest, bends: zero.clone(), lumps: zero }
    }

    fn add(&mut self, v: Corners, area: f64) {
        let at = |x: f64| 1.0 + lesser(greater(x * self.per_length, 0.0), Self::PLACES as f64);
        let [a, b, c] = super::linear::ascending(v).map(at);
        let share = |row: &mut [f64], x: f64, amount: f64| {
            // Casting saturates, and takes what is no number for zero.
            let place = (x as usize).min(Self::PLACES + 2);
            let part = x - place as f64;
            row[place] += amount * (1.0 - part);
            row[place + 1] += amount * part;
        };
        if c - a < 1.0 {
            share(&mut self.lumps, (a + b + c) * (1.0 / 3.0), area);
            return;
        }
        let (rise, fall) = (greater(b - a, LEAST_RISE), greater(c - b, LEAST_RISE));
        let height = 2.0 * area / (rise + fall);
        share(&mut self.bends, b - rise, height / rise);
        share(&mut self.bends, b, -height / rise - height / fall);
        share(&mut self.bends, b + fall, height / fall);
    }

    fn plus(mut self, other: &Self) -> Self {
        let both = self.bends.iter_mut().chain(&mut self.lumps);
        for (sum, more) in both.zip(other.bends.iter().chain(&other.lumps)) {
            *sum += more;
        }
        self
    }

    /// About the least distances that shares of the area do not exceed.
    fn levels(&self, shares: &[f64]) -> Vec<f64> {
        let (mut slope, mut density, mut sum) = (0.0, 0.0, 0.0);
        let step = |(bend, lump): (&f64, &f64)| {
            let before = density;
            density += slope;
            slope += bend;
            sum += 0.5 * (before + density) + lump;
            sum
        };
        let sums: Vec<f64> = self.bends.iter().zip(&self.lumps).map(step).collect();
        let of_share = |share: &f64| {
            let wanted = share * sum;
            let place = sums.partition_point(|sum| *sum < wanted);
            let before = if place > 0 { sums[place - 1] } else { 0.0 };
            let here = sums.get(place).copied().unwrap_or(wanted);
            let part = if here > before { (wanted - before) / (here - before) } else { 0.0 };
            greater(place as f64 - 2.0 + part, 0.0) / self.per_length
        };
        shares.iter().map(of_share).collect()
    }
}

/// Levels in ascending order, at which areas are summed up together.
#[derive(Clone, Copy)]
struct Scale([f64; LEVELS]);

impl Scale {
    fn around(level: f64, fine: f64) -> Self {
        Self(std::array::from_fn(|i| level * (1.0 + 0.9 * fine * (i as f64 - 0.5 * (LEVELS - 1) as f64))))
    }
}

/// The areas up to the levels of a scale: those of all entries that lie below it, and the parts of others.
#[derive(Clone, Copy)]
struct Tally {
    below: f64,
    sums: [f64; LEVELS],
}

impl Default for Tally {
    fn default() -> Self {
        Self { below: 0.0, sums: [0.0; LEVELS] }
    }
}

impl Tally {
    fn add(&mut self, side: Side, part: &PartUpTo, weight: f64, scale: &Scale) {
        part.add(side == Side::Lower, weight, &scale.0, &mut self.sums);
    }

    /// Between which of the levels so much area is reached, and how much lies there at most; about where to look where it is not between them.
    fn crossing(&self, side: Side, wanted: f64, scale: &Scale, entries: usize) -> (f64, f64, f64) {
        let reached = self.sums.iter().position(|sum| side.reaches(self.below + sum, wanted, entries));
        let wide = |from: f64, to: f64| WIDE * (to - from);
        let (first, last) = (scale.0[0], scale.0[LEVELS - 1]);
        match reached {
            Some(0) => (greater(first - wide(first, last), 0.0), first, f64::INFINITY),
            Some(i) => (scale.0[i - 1], scale.0[i], self.sums[i] - self.sums[i - 1]),
            None => (last, last + wide(first, last), f64::INFINITY),
        }
    }
}

fn sum_up_to(side: Side, active: &[(PartUpTo, f64)], level: f64) -> f64 {
    active.iter().map(|(part, weight)| weight * side.part(part, level)).sum()
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

/// Factors that outweigh the rounding of a few products.
pub(super) const MORE: f64 = 1.0 + 8.0 * f64::EPSILON;
pub(super) const LESS: f64 = 1.0 - 8.0 * f64::EPSILON;
/// Portions summed at a time; fixed, so that sums do not depend on the number of threads.
const PORTIONS: usize = 16;
/// Entries of which the distribution is forecast, about.
const FORECAST: usize = 1 << 16;
/// Levels of a scale, and the part of a level by which they lie apart at most; less of the levels at the lower end than of those at
/// the upper end.
const LEVELS: usize = 32;
const COARSEST: f64 = 5e-3;
/// Ends of bins at which areas are summed up together.
const TOGETHER: usize = 8;
/// A part of an area that is much for two levels close to each other.
const LUMP: f64 = 0.02;
/// Places on a grid between which slopes may change, at least.
const LEAST_RISE: f64 = 0.25;
/// How far beside a scale a percentile is looked for at first, in lengths of the scale.
const WIDE: f64 = 4.0;
/// Levels that are tried at most for a percentile.
const PROBES: usize = 120;
/// How far beside the level that is expected, as a part of the range.
const CLOSE: f64 = 0.02;
