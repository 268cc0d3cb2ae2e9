//! Percentiles: the least distance that a share of the area does not exceed, from below and from above.
//!
//! Areas are summed up at many levels at a time (`tally`), for all percentiles together; between the two levels where the share is
//! reached, the same is done again, until they are close to each other.

use super::distribution::{Distribution, PORTIONS};
use super::entry::{LESS, MORE};
use super::forecast::Forecast;
use super::linear::{greater, greatest, least, lesser};
use super::portion::Portion;
use super::tally::{LEVELS, Scale, Side, Tally};
use pompeiu_core::exact::Interval;
use rayon::prelude::*;

/// The part of a level by which those of a scale lie apart at most.
const COARSEST: f64 = 5e-3;
/// How far beside a scale a percentile is looked for first: in lengths of the scale, as a part of the level, and at least. So often;
/// then anywhere.
const BESIDE: f64 = 4.0;
const NEAR: f64 = 0.02;
const LEAST: f64 = 1e-15;
const MISSES: u32 = 2;
/// Levels that are no farther apart are close to each other: far less than the rounding of a length in the frame.
const NOTHING: f64 = 1e-18;
/// Entries of which the distribution is forecast, about.
const FORECAST: usize = 1 << 14;
/// The first places of a grid, as a part of it; where the next one ends, in levels; and grids after the first, at most.
const FIRST_PLACES: f64 = 1.0 / 64.0;
const AFTER: f64 = 4.0;
const GRIDS: usize = 4;
/// How often areas are summed up at most.
const PASSES: usize = 40;
/// A part of an area that is much for two levels close to each other.
const LUMP: f64 = 0.02;

/// One end of a percentile that is looked for: up to the first of two levels less than the area wanted lies for certain, up to the
/// second not less.
#[derive(Clone, Copy)]
struct End {
    side: Side,
    wanted: f64,
    low: f64,
    high: f64,
    /// Whether that is known of the levels.
    holds: [bool; 2],
    /// No more area lies between; infinite where that is not known.
    between: f64,
    misses: u32,
    is_found: bool,
}

impl Distribution {
    /// Encloses for each share the least distance that so much of the area does not exceed, up to a part `fine` of itself.
    pub(super) fn enclosed_percentiles(
        &self,
        shares: &[f64],
        area: Interval,
        largest: f64,
        fine: f64,
    ) -> Vec<(f64, f64)> {
        let fine = lesser(fine, COARSEST);
        let entries = self.len();
        let [lower, upper] = self.expected(shares, largest);
        let of_side = |side, expected: Vec<f64>| -> Vec<(End, Scale)> {
            let new = |(share, level): (&f64, f64)| {
                let wanted = match side {
                    Side::Lower => share * area.lower() * LESS,
                    Side::Upper => share * area.upper() * MORE,
                };
                (End::new(side, wanted), Scale::around(level, fine, largest))
            };
            shares.iter().zip(expected).map(new).collect()
        };
        let mut ends = [of_side(Side::Lower, lower), of_side(Side::Upper, upper)];
        let mut ranges = Vec::new();
        for _ in 0..PASSES {
            let unknown = ends.each_ref().map(|ends| {
                let unknown = ends.iter().filter(|(end, _)| !end.is_found);
                unknown.map(|(_, scale)| *scale).collect::<Vec<Scale>>()
            });
            if unknown.iter().all(Vec::is_empty) {
                break;
            }
            let tallies = self.tallies(&unknown, &mut ranges);
            for (ends, tallies) in ends.iter_mut().zip(tallies) {
                let unknown = ends.iter_mut().filter(|(end, _)| !end.is_found);
                for ((end, scale), tally) in unknown.zip(tallies) {
                    end.narrow(scale, &tally, entries, largest, fine);
                    *scale = Scale::between(end.low, end.high);
                }
            }
        }
        let found = ends.map(|ends| -> Vec<(f64, f64)> {
            // Rounding of the sums does not matter: this steers only how narrow the ends are.
            let of_end = |(end, _): &(End, Scale)| {
                let settled = end.between < LUMP * end.wanted;
                if settled { (end.low, end.high) } else { self.moved_to_values(end) }
            };
            ends.par_iter().map(of_end).collect()
        });
        let at_most = |level: f64| lesser(level, largest);
        let [lower, upper] = found;
        lower.into_iter().zip(upper).map(|(lower, upper)| (at_most(lower.0), at_most(upper.1))).collect()
    }

    /// Two levels moved towards each other, to the next values of entries, if much area lies between them and no entry reaches over
    /// one: from there to the next value sums stay the same.
    fn moved_to_values(&self, &End { side, wanted, low, high, .. }: &End) -> (f64, f64) {
        let mut inside = 0.0;
        let (mut low_is_crossed, mut high_is_crossed) = (false, false);
        let (mut next, mut last) = (high, low);
        for entry in self.portions.iter().flat_map(|portion| portion.entries.iter()) {
            let (v, weight) = side.of(&entry);
            let (from, to) = (least(v), greatest(v));
            if from > high || to <= low {
                continue;
            }
            inside += if from > low && to <= high { weight } else { 0.0 };
            low_is_crossed |= from <= low && low < to;
            high_is_crossed |= from <= high && high < to;
            next = if from > low { lesser(next, from) } else { next };
            last = if to <= high { greater(last, to) } else { last };
        }
        if inside < LUMP * wanted {
            return (low, high);
        }
        (if low_is_crossed { low } else { next }, if high_is_crossed { high } else { last })
    }

    /// About where the percentiles of both functions lie. Those among the first places of a grid are looked for on one that ends soon
    /// after them.
    fn expected(&self, shares: &[f64], largest: f64) -> [Vec<f64>; 2] {
        let mut end = largest;
        let mut expected = self.forecasts(end).map(|forecast| forecast.levels(shares));
        for _ in 0..GRIDS {
            let first = FIRST_PLACES * end;
            let greatest =
                expected.iter().flatten().filter(|level| **level < first).fold(0.0, |x, y| greater(x, *y));
            if greatest <= 0.0 {
                break;
            }
            end = AFTER * greatest;
            let finer = self.forecasts(end).map(|forecast| forecast.levels(shares));
            for (level, finer) in expected.iter_mut().flatten().zip(finer.into_iter().flatten()) {
                *level = if *level < first { finer } else { *level };
            }
        }
        expected
    }

    /// About how much area is how far away as both functions say: of some entries, if there are many.
    fn forecasts(&self, largest: f64) -> [Forecast; 2] {
        let step = (self.len() / FORECAST).max(1);
        let new = || [Forecast::new(largest), Forecast::new(largest)];
        let of_entries = |portions: &[Portion]| {
            let [mut lower, mut upper] = new();
            for entry in portions.iter().flat_map(|portion| portion.entries.iter()).step_by(step) {
                lower.add(entry.lower(), entry.area().0);
                upper.add(entry.upper(), entry.area().0);
            }
            [lower, upper]
        };
        let plus = |[a, b]: [Forecast; 2], [c, d]: &[Forecast; 2]| [a.plus(c), b.plus(d)];
        // Fewer and larger chunks: each takes memory of its own.
        let chunks: Vec<[Forecast; 2]> = self.portions.par_chunks(8 * PORTIONS).map(of_entries).collect();
        chunks.iter().fold(new(), plus)
    }
}

impl End {
    fn new(side: Side, wanted: f64) -> Self {
        let (between, misses) = (f64::INFINITY, 0);
        Self { side, wanted, low: 0.0, high: 0.0, holds: [false; 2], between, misses, is_found: false }
    }

    /// Takes the two levels of a scale between which the area is reached, or looks beside it.
    fn narrow(&mut self, Scale(levels): &Scale, tally: &Tally, entries: usize, largest: f64, fine: f64) {
        let before = (self.low, self.high, self.holds);
        let reached = |sum: &f64| self.side.reaches(tally.below + sum, self.wanted, entries);
        let reached = tally.sums.iter().position(reached);
        let (first, last) = (levels[0], levels[LEVELS - 1]);
        let beside = |level: f64| greater(BESIDE * (last - first), NEAR * level) + LEAST;
        self.between = f64::INFINITY;
        match reached {
            Some(0) => {
                self.misses += 1;
                let low = if self.misses > MISSES { 0.0 } else { greater(first - beside(first), 0.0) };
                // Outside of zero and the largest distance is nothing to be found.
                (self.low, self.high, self.holds) = (low, first, [first <= 0.0, true]);
            }
            Some(i) => {
                (self.low, self.high, self.holds) = (levels[i - 1], levels[i], [true; 2]);
                self.between = tally.sums[i] - tally.sums[i - 1];
            }
            None => {
                self.misses += 1;
                let high = if self.misses > MISSES { largest } else { lesser(last + beside(last), largest) };
                (self.low, self.high, self.holds) = (last, high, [true, last >= largest]);
            }
        }
        let is_narrow = self.high - self.low <= greater(fine * self.high, NOTHING);
        self.is_found = self.holds == [true; 2] && (is_narrow || before == (self.low, self.high, self.holds));
    }
}

#[cfg(test)]
mod tests {
    use super::super::distribution::Measured;
    use super::super::entry::{Entry, Moments};
    use super::super::linear::Corners;
    use super::super::packed::Entries;
    use super::super::polygon::{MOST_CORNERS, Polygon};
    use super::*;
    use proptest::prelude::*;

    /// A triangle of area one over which the distance is known.
    fn known([a, b, c]: Corners) -> Entry {
        let mut whole = Polygon::whole(0.0);
        let mut row = [c; MOST_CORNERS];
        (row[0], row[1]) = (a, b);
        (whole.lower, whole.upper) = (row, row);
        Entry::new(&whole, [0, 1, 2], (1.0, 1.0))
    }

    fn distribution(values: &[Corners]) -> Distribution {
        let entries: Vec<Entry> = values.iter().map(|v| known(*v)).collect();
        let moments = Moments::of(entries.iter().copied());
        let starts = vec![0, entries.len() as u32];
        let entries = Entries::Full(entries);
        Distribution { portions: vec![Portion { entries, starts, moments }] }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        /// Less than the share lies below a percentile, and not less up to it; of sizes that differ by many orders of magnitude,
        /// and whatever is expected of them.
        #[test]
        fn percentiles_enclose(
            values in prop::collection::vec((prop::array::uniform3(0.0..1.0_f64), 0..12_i32, 0.0..1e-3_f64), 1..40),
            share in 0.01..0.99_f64,
            fine in prop_oneof![Just(1e-3), Just(1e-6), Just(1e-9)],
        ) {
            let of = |(v, order, least): &([f64; 3], i32, f64)| v.map(|x| least + x * 10.0_f64.powi(-order));
            let distribution = distribution(&values.iter().map(of).collect::<Vec<Corners>>());
            let area = distribution.moments().area.enclosure();
            let (low, high) = distribution.percentiles(&[share], area, 1.1, fine)[0];
            prop_assert!(distribution.area_up_to(low * (1.0 - 1e-9)).lower() <= share * area.upper());
            prop_assert!(distribution.area_up_to(high).upper() >= share * area.lower());
            // The function above was rounded up by some digits of the width.
            prop_assert!(high - low <= 3.0 * fine * high + 1e-12, "{low} {high}");
        }
    }

    /// Much of the area at one distance: the percentile is that distance, and of nothing it is zero.
    #[test]
    fn lumps_are_met_exactly() {
        let values: Vec<Corners> = [0.0, 0.0, 0.0, 0.25, 0.25, 0.25, 0.25, 0.5].map(|x| [x; 3]).to_vec();
        let distribution = distribution(&values);
        let area = distribution.moments().area.enclosure();
        let found = distribution.percentiles(&[0.2, 0.6, 0.95], area, 0.5, 1e-3);
        for ((low, high), exact) in found.into_iter().zip([0.0, 0.25, 0.5]) {
            assert!(low <= exact && exact <= high && high - low < 1e-12, "{low} {exact} {high}");
        }
    }
}
