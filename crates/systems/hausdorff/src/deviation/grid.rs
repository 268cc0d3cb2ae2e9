//! How much of an area is up to how far away, summed up on grids: memory does not grow with the number of triangles.
//!
//! The part of a triangle on which a linear function with the values `a < b < c` at its corners is at most `t` is quadratic in `t` from `a` to
//! `b` and from `b` to `c`. With values rounded to places of a grid, and the area a multiple of `(b - a) (c - b) (c - a)` of a unit, all of it
//! is in integers: at each of its three places the curvature changes by an integer. Sums of integers are exact, in any order.
//!
//! # What is proven
//! * Values of the function above are rounded up, areas down: what is summed up is no more than the area up to any place.
//! * Values of the function below are rounded down, areas up: no less.
//!
//! A triangle goes to the finest level whose places reach to its values, so that rounding moves the greatest of them by at most [`MOST_MOVED`] of
//! itself, but no further than [`MOST_MOVED`] of the lowest level, wherever it lies. Between places, sums are taken at the place below, or above.
//!
//! Small values of a triangle that also has great ones are moved by a large part of themselves. Where that matters, triangles are cut along a contour
//! of their function: what lies below it goes to finer levels. The shares of the parts are quotients of differences of values, and rounded as areas are.

use super::entry::{Entry, LESS, MORE, Sum};
use super::linear::{Corners, ascending, greater, lesser};
use super::tally::{Side, Weighted};
use crate::rounding::Rounding;
use pompeiu_core::exact::Interval;
use std::sync::{Mutex, PoisonError};

/// Places of a level, as an exponent of two.
const PLACES: i32 = 13;
const LAST: i64 = 1 << PLACES;
/// What rounding up moves values by, at most: three values that are different come of three equal ones.
const MOST_PLACES: i64 = 3;
/// The same as a part of a value in the upper half of a level.
pub(super) const MOST_MOVED: f64 = 2.0 * MOST_PLACES as f64 / LAST as f64;
/// The lowest level reaches to no more than so many times the widths that do not matter: places lie far closer together.
const OF_FLOOR: f64 = LAST as f64 / 32.0;
/// The units of area that the whole area has at least, as an exponent of two; sums of several times as much fit into integers.
const UNITS: i32 = 110;
/// Levels at most.
const MOST_LEVELS: i32 = 64;
/// Levels between two contours: values right above the first one are then moved by less than 1/20 of themselves.
const LEVELS_BETWEEN_CONTOURS: usize = 6;

/// Where levels lie, and what a unit of area is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ruler {
    /// The places of the lowest level reach to two to this power, those of the next one twice as far.
    lowest: i32,
    levels: i32,
    /// There are two to this power of units in an area of one.
    units: i32,
}

/// What comes together of the triangles of a level beside changes of curvature.
#[derive(Clone, Copy, Debug, Default)]
struct Level {
    /// What comes from values below zero: area, slope and curvature at zero.
    at_zero: [i128; 3],
    /// The area of all triangles.
    total: i128,
}

/// Sums over triangles, for the function below the distance and for the one above it.
#[derive(Clone, Debug)]
pub(super) struct Grids {
    ruler: Ruler,
    /// By function and level.
    levels: [Vec<Level>; 2],
    /// Changes of curvature by function, level and place.
    bends: Vec<i128>,
    /// Changes that are yet to be added, by index: places lie far apart in memory, and many that do not depend on each other are
    /// fetched at the same time.
    pending: Vec<(u32, i128)>,
    /// Values, ascending, at which triangles are cut.
    contours: Vec<f64>,
    triangles: u64,
}

/// Places of a level in memory.
const SIZE: usize = (LAST + MOST_PLACES) as usize;
/// Changes that are added together, and what one triangle adds at most.
const TOGETHER: usize = 192;
const OF_TRIANGLE: usize = 6;
/// The functions in the order of the sums.
const SIDES: [Side; 2] = [Side::Lower, Side::Upper];

impl Ruler {
    /// For areas of about `total` in a frame, of which widths up to the floor do not matter.
    pub(super) fn new(total: f64, rounding: Rounding, floor: f64) -> Self {
        // No two points are farther apart than 2 sqrt(3) times the greatest coordinate.
        let highest = exponent_not_below(4.0 * rounding.size());
        let lowest = exponent_not_below(OF_FLOOR * floor);
        let lowest = lowest.clamp(highest - (MOST_LEVELS - 1), highest);
        let units = if total > 0.0 { UNITS - exponent_not_below(total) } else { 0 };
        Self { lowest, levels: highest - lowest + 1, units: units.clamp(-900, 900) }
    }

    /// Bytes of grids at most.
    pub(super) fn bytes(&self) -> usize {
        2 * self.count() * SIZE * size_of::<i128>()
    }

    /// How many levels there are.
    fn count(&self) -> usize {
        self.levels as usize
    }

    /// Ends of levels, ascending, below which ranges of values lie, and of levels above them at some distance: what lies between two ends is not
    /// moved to far below the first.
    fn ends_above(&self, ranges: &[(f64, f64)]) -> Vec<f64> {
        let first = |(_, high): &(f64, f64)| exponent_not_below(2.0 * high).max(self.lowest);
        let highest = self.lowest + self.levels;
        let mut ends: Vec<i32> = ranges
            .iter()
            .flat_map(|range| (first(range)..highest).step_by(LEVELS_BETWEEN_CONTOURS))
            .collect();
        ends.sort_unstable();
        ends.dedup();
        ends.into_iter().map(power_of_two).collect()
    }

    /// Places of a level in a length of one.
    fn places_per_length(&self, level: i32) -> f64 {
        power_of_two(PLACES - self.lowest - level)
    }
}

impl Grids {
    pub(super) fn new(ruler: Ruler) -> Self {
        let levels = [(); 2].map(|()| vec![Level::default(); ruler.count()]);
        // Memory of zeros that is never written to is not taken.
        let bends = vec![0; 2 * ruler.count() * SIZE];
        let (pending, contours) = (Vec::with_capacity(TOGETHER + OF_TRIANGLE), Vec::new());
        Self { ruler, levels, bends, pending, contours, triangles: 0 }
    }

    /// The same with triangles cut at some values, ascending, so that those below are rounded less.
    fn cut_at(self, contours: &[f64]) -> Self {
        Self { contours: contours.to_vec(), ..self }
    }

    /// Takes a triangle in.
    pub(super) fn add(&mut self, entry: &Entry) {
        self.triangles += 1;
        for (k, side) in SIDES.into_iter().enumerate() {
            let (v, weight) = side.of(entry);
            self.add_parts(k, side, (v, weight), self.contours.len());
        }
        if self.pending.len() >= TOGETHER {
            self.settle();
        }
    }

    /// Adds a triangle, cut along the first of the contours.
    fn add_parts(&mut self, k: usize, side: Side, (v, weight): Weighted, contours: usize) {
        let [a, b, c] = ascending(v);
        let crossing = (0..contours).rev().find(|i| a < self.contours[*i] && self.contours[*i] < c);
        let Some(crossing) = crossing else { return self.add_to(k, side, v, weight) };
        for (part, share) in parts_beside(self.contours[crossing], [a, b, c]) {
            let share = match side {
                Side::Lower => share * MORE,
                Side::Upper => share * LESS,
            };
            self.add_parts(k, side, (part, weight * share), crossing);
        }
    }

    fn settle(&mut self) {
        for (index, by) in self.pending.drain(..) {
            let bend = &mut self.bends[index as usize];
            *bend = bend.wrapping_add(by);
        }
    }

    /// Takes in what others hold, whose ruler is the same.
    pub(super) fn plus(&mut self, mut others: Self) {
        self.settle();
        others.settle();
        self.triangles += others.triangles;
        for (level, other) in self.levels.iter_mut().flatten().zip(others.levels.iter().flatten()) {
            level.plus(other);
        }
        let used = others.levels.iter().flatten().map(|level| level.total != 0);
        let levels = self.bends.chunks_mut(SIZE).zip(others.bends.chunks(SIZE)).zip(used);
        for ((bends, others), _) in levels.filter(|(_, used)| *used) {
            for (bend, other) in bends.iter_mut().zip(others) {
                *bend = bend.wrapping_add(*other);
            }
        }
    }

    /// How much area is up to each place.
    pub(super) fn areas(mut self) -> Areas {
        self.settle();
        let Self { ruler, levels, bends, triangles, .. } = self;
        let mut bends = bends.chunks(SIZE);
        let of_side = |levels: Vec<Level>| -> Vec<Vec<f64>> {
            let of_level = |(level, bends): (Level, &[i128])| level.up_to_places(bends, ruler.units);
            levels.into_iter().zip(bends.by_ref()).map(of_level).collect()
        };
        Areas { ruler, sides: levels.map(of_side), triangles }
    }

    fn add_to(&mut self, k: usize, side: Side, v: Corners, weight: f64) {
        let Self { ruler, levels, pending, .. } = self;
        let [a, b, c] = ascending(v);
        let level = (exponent_not_below(greater(c, -a)) - ruler.lowest).max(0);
        let units = weight * power_of_two(ruler.units);
        if level >= ruler.levels {
            // Out of reach: anywhere, or nowhere.
            if side == Side::Lower {
                let area = units.ceil() as i128;
                levels[k][0].plus(&Level { at_zero: [area, 0, 0], total: area });
            }
            return;
        }
        let scale = ruler.places_per_length(level);
        let places = match side {
            Side::Lower => {
                let [a, b, c] = [a, b, c].map(|x| place_not_above(x * scale));
                let b = b.min(c - 1);
                [a.min(b - 1), b, c]
            }
            Side::Upper => {
                let [a, b, c] = [a, b, c].map(|x| place_not_below(x * scale));
                let b = b.max(a + 1);
                [a, b, c.max(b + 1)]
            }
        };
        let [a, b, c] = places;
        // At most 2^42: exact.
        let parts = units / ((b - a) * (c - b) * (c - a)) as f64;
        let parts = match side {
            Side::Lower => (parts * MORE) as i128 + 1,
            Side::Upper => (parts * LESS) as i128,
        };
        let level = level as usize;
        let first = (k * ruler.count() + level) * SIZE;
        levels[k][level].add(places, parts, |place, by| pending.push(((first + place as usize) as u32, by)));
    }
}

/// Grids that threads add to.
pub(super) struct SharedGrids(Vec<Mutex<Grids>>);

/// Threads that share one of them.
const SHARING: usize = 4;

impl SharedGrids {
    /// With triangles cut at the ends of the levels in which some ranges of values lie.
    pub(super) fn new(ruler: Ruler, ranges: &[(f64, f64)]) -> Self {
        let count = rayon::current_num_threads().div_ceil(SHARING);
        let contours = ruler.ends_above(ranges);
        Self((0..count).map(|_| Mutex::new(Grids::new(ruler).cut_at(&contours))).collect())
    }

    /// Takes triangles in; which thread does so makes no difference, for sums of integers do not depend on their order.
    pub(super) fn add(&self, entries: &[Entry]) {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let mut grids = self.0[thread % self.0.len()].lock().unwrap_or_else(PoisonError::into_inner);
        for entry in entries {
            grids.add(entry);
        }
    }

    pub(super) fn areas(self) -> Option<Areas> {
        let mut grids =
            self.0.into_iter().map(|grids| grids.into_inner().unwrap_or_else(PoisonError::into_inner));
        let mut all = grids.next()?;
        for others in grids {
            all.plus(others);
        }
        Some(all.areas())
    }
}

impl Level {
    /// A triangle with its values at three places, and an area of so many times the product of their differences.
    /// `bend` is told of the changes of curvature.
    fn add(&mut self, [a, b, c]: [i64; 3], parts: i128, mut bend: impl FnMut(i64, i128)) {
        // Curvatures between the places, such that slopes agree at the middle one.
        let rising = parts.wrapping_mul(i128::from(c - b));
        let falling = parts.wrapping_mul(i128::from(b - a));
        let area = rising.wrapping_mul(i128::from((b - a) * (c - a)));
        self.total = self.total.wrapping_add(area);
        let known = if a >= 0 {
            bend(a, rising);
            [0; 3]
        } else {
            let [p, q] = [-a, c].map(i128::from);
            match (b, c) {
                (0.., _) => [rising.wrapping_mul(p * p), rising.wrapping_mul(2 * p), rising],
                (_, 1..) => [
                    area.wrapping_sub(falling.wrapping_mul(q * q)),
                    falling.wrapping_mul(2 * q),
                    falling.wrapping_neg(),
                ],
                _ => [area, 0, 0],
            }
        };
        if b >= 0 {
            bend(b, rising.wrapping_add(falling).wrapping_neg());
        }
        if b >= 0 || c > 0 {
            bend(c, falling);
        }
        for (sum, more) in self.at_zero.iter_mut().zip(known) {
            *sum = sum.wrapping_add(more);
        }
    }

    fn plus(&mut self, other: &Self) {
        let sums = self.at_zero.iter_mut().chain([&mut self.total]);
        for (sum, more) in sums.zip(other.at_zero.iter().chain([&other.total])) {
            *sum = sum.wrapping_add(*more);
        }
    }

    /// The area up to each place, and all of it at the end; nothing without a triangle.
    fn up_to_places(self, bends: &[i128], units: i32) -> Vec<f64> {
        if self.total == 0 {
            return Vec::new();
        }
        let area = |units_of_area: i128| units_of_area as f64 * power_of_two(-units);
        let [mut sum, mut slope, mut curvature] = self.at_zero;
        let mut areas: Vec<f64> = Vec::with_capacity(bends.len() + 1);
        for bend in bends {
            areas.push(area(sum));
            curvature = curvature.wrapping_add(*bend);
            sum = sum.wrapping_add(slope).wrapping_add(curvature);
            slope = slope.wrapping_add(curvature.wrapping_mul(2));
        }
        areas.push(area(self.total));
        areas
    }
}

/// Three triangles into which a contour cuts one with ascending values, between the first and the last of them, and which share of the area each has,
/// rounded six times.
fn parts_beside(at: f64, [a, b, c]: Corners) -> [Weighted; 3] {
    let (below, above) = (at - a, c - at);
    if at <= b {
        let (near, far) = (below / (b - a), below / (c - a));
        [([a, at, at], near * far), ([at, b, c], (b - at) / (b - a)), ([at, at, c], near * (above / (c - a)))]
    } else {
        let (near, far) = (above / (c - b), above / (c - a));
        [([at, at, c], near * far), ([a, b, at], below / (c - a)), ([b, at, at], far * ((at - b) / (c - b)))]
    }
}

/// How much area is up to how far away, from below and from above.
#[derive(Clone, Debug)]
pub(super) struct Areas {
    ruler: Ruler,
    /// By level and place.
    sides: [Vec<Vec<f64>>; 2],
    triangles: u64,
}

impl Areas {
    /// Triangles that were taken in.
    pub(super) fn triangles(&self) -> u64 {
        self.triangles
    }

    pub(super) fn bytes(&self) -> usize {
        self.sides.iter().flatten().map(|level| size_of_val(&level[..])).sum()
    }

    /// The area up to a level that is not negative: no more, or no less.
    fn up_to(&self, side: Side, level: f64) -> f64 {
        let (levels, place) = match side {
            Side::Lower => (&self.sides[0], place_not_below as fn(f64) -> i64),
            Side::Upper => (&self.sides[1], place_not_above as fn(f64) -> i64),
        };
        let of_level = |(k, areas): (i32, &Vec<f64>)| {
            let Some(last) = areas.len().checked_sub(1) else { return 0.0 };
            let x = lesser(level * self.ruler.places_per_length(k), last as f64);
            areas[(place(x).max(0) as usize).min(last)]
        };
        (0..).zip(levels).map(of_level).sum()
    }
}

/// More than what a sum over all levels of several grids is off by, relative to itself.
const SLACK: f64 = 1024.0 * f64::EPSILON;

/// Encloses the area up to a level, of several areas together.
pub(super) fn area_up_to(areas: &[Areas], level: f64) -> Interval {
    let sum = |side| areas.iter().map(|areas| areas.up_to(side, level)).sum::<f64>();
    let (low, high) = (sum(Side::Upper) * (1.0 - SLACK), sum(Side::Lower) * (1.0 + SLACK));
    Interval::spanning(lesser(low, high), high)
}

/// The same as a sum.
pub(super) fn sum_up_to(areas: &[Areas], level: f64) -> Sum {
    let area = area_up_to(areas, level);
    Sum::of(area.lower(), area.upper(), 0.0)
}

/// Encloses for each share the least distance that so much of the area does not exceed.
pub(super) fn percentiles(areas: &[Areas], shares: &[f64], area: Interval, largest: f64) -> Vec<(f64, f64)> {
    let of_share = |share: &f64| {
        let reached = |level: f64| area_up_to(areas, level);
        // What may be reached, and what must be.
        let low = first(largest, |level| reached(level).upper() >= share * area.lower() * LESS).0;
        let high = first(largest, |level| reached(level).lower() >= share * area.upper() * MORE).1;
        (lesser(low, high), high)
    };
    shares.iter().map(of_share).collect()
}

/// Two neighbouring numbers between zero and a greatest one, of which the condition, which holds from some number on, holds of the second only; or
/// zero twice, or the greatest.
fn first(greatest: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    if holds(0.0) {
        return (0.0, 0.0);
    }
    // Numbers that are not negative are in the order of their bits.
    let (mut low, mut high) = (0, greatest.to_bits());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if holds(f64::from_bits(middle)) { high = middle } else { low = middle }
    }
    (f64::from_bits(low), f64::from_bits(high))
}

/// The least exponent with a power of two that is no less than a number; a low one where that is not positive.
fn exponent_not_below(x: f64) -> i32 {
    const FRACTION: u64 = (1 << 52) - 1;
    const BIAS: i32 = 1023;
    if x > 0.0 { ((x.to_bits() + FRACTION) >> 52) as i32 - BIAS } else { -BIAS }
}

/// Exact, of exponents of normal numbers.
fn power_of_two(exponent: i32) -> f64 {
    const BIAS: i32 = 1023;
    f64::from_bits(((exponent.clamp(1 - BIAS, BIAS) + BIAS) as u64) << 52)
}

fn place_not_above(x: f64) -> i64 {
    let place = x as i64;
    place - i64::from(place as f64 > x)
}

fn place_not_below(x: f64) -> i64 {
    let place = x as i64;
    place + i64::from((place as f64) < x)
}

#[cfg(test)]
mod tests {
    use super::super::linear::{FEW_OPERATIONS, PartUpTo};
    use super::*;
    use proptest::prelude::*;

    const FLOOR: f64 = 1e-9;

    fn ruler(total: f64) -> Ruler {
        Ruler::new(total, Rounding::new(1.0), FLOOR)
    }

    /// Entries whose function below may be negative, with values of many orders of magnitude, equal ones among them.
    fn entries() -> impl Strategy<Value = Vec<Entry>> {
        let value = prop_oneof![3 => 0.0..1.0_f64, 1 => (0..4_i32).prop_map(|k| 0.25 * f64::from(k))];
        let entry = (prop::array::uniform3(value), 0..9_i32, -1.0..2.0_f64, 0.0..0.1_f32, 1e-6..1.0_f64);
        let entry = entry.prop_map(|(v, order, shift, width, area)| {
            let scale = 10.0_f64.powi(-order);
            let lower = v.map(|x| scale * (x + if shift < 0.0 { shift } else { 0.0 }));
            // The function above is nowhere negative.
            let width = lower.map(|x| (if x < 0.0 { -x } else { 0.0 } + scale * f64::from(width)) as f32);
            Entry { lower, width: width.map(f32::next_up), area, more: 1e-7 * area as f32 }
        });
        prop::collection::vec(entry, 1..30)
    }

    fn areas(entries: &[Entry], ruler: Ruler) -> Areas {
        let mut grids = Grids::new(ruler);
        for entry in entries {
            grids.add(entry);
        }
        grids.areas()
    }

    fn areas_cut_at(contours: &[f64], entries: &[Entry], ruler: Ruler) -> Areas {
        let mut grids = Grids::new(ruler).cut_at(contours);
        for entry in entries {
            grids.add(entry);
        }
        grids.areas()
    }

    /// The same from every entry by itself, rounded outwards by [`FEW_OPERATIONS`] of its area: more than sums of tiny parts are.
    fn exactly(entries: &[Entry], level: f64) -> (f64, f64) {
        let of = |(low, high): (f64, f64), entry: &Entry| {
            let (least, most) = entry.area();
            let below = least * PartUpTo::new(entry.upper()).below(level);
            (low + below, high + most * PartUpTo::new(entry.lower()).above(level))
        };
        entries.iter().fold((0.0, 0.0), of)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        /// What is summed up at a place lies outside of the exact sums there, and inside of those a little beside.
        #[test]
        fn sums_lie_outside_of_exact_ones(entries in entries(), level in 0.0..1.2_f64, order in 0..10_i32) {
            let total: f64 = entries.iter().map(|entry| entry.area().1).sum();
            let ruler = ruler(total);
            let areas = [areas(&entries, ruler)];
            let level = level * 10.0_f64.powi(-order);
            let found = area_up_to(&areas, level);
            let (low, high) = exactly(&entries, level);
            let doubt = 2.0 * FEW_OPERATIONS * total;
            prop_assert!(found.lower() <= low + doubt && high <= found.upper() + doubt, "{found:?} {low} {high}");
            // Each entry by itself, for those with greater values are rounded to coarser places.
            for entry in &entries {
                let areas = [self::areas(&[*entry], ruler)];
                let greatest = entry.lower().into_iter().chain(entry.upper()).fold(0.0, |m: f64, x| m.max(x.abs()));
                let beside = MOST_MOVED * greatest + FLOOR;
                let found = area_up_to(&areas, level);
                let (low, high) = (exactly(&[*entry], level - beside).0, exactly(&[*entry], level + beside).1);
                prop_assert!(low * (1.0 - 1e-9) <= found.lower() && found.upper() <= high * (1.0 + 1e-9) + 1e-20, "{found:?} {low} {high}");
            }
        }

        /// Less than the share lies below a percentile, and not less up to it.
        #[test]
        fn percentiles_enclose(entries in entries(), share in 0.01..0.99_f64) {
            let total = entries.iter().fold((0.0, 0.0), |(low, high), entry| (low + entry.area().0, high + entry.area().1));
            let (low, high) = percentiles(&[areas(&entries, ruler(total.1))], &[share], Interval::spanning(total.0, total.1), 4.0)[0];
            prop_assert!(exactly(&entries, low).0 <= share * total.1, "{low}");
            prop_assert!(exactly(&entries, high * (1.0 + 1e-9)).1 >= share * total.0, "{high}");
        }

        /// Cut along contours, triangles take up the same areas, and what lies below the first is rounded as triangles below it are.
        #[test]
        fn contours_leave_less_to_rounding(entries in entries(), order in 0..9_i32, part in 0.01..0.45_f64) {
            let total: f64 = entries.iter().map(|entry| entry.area().1).sum();
            let ruler = ruler(total);
            let high = 10.0_f64.powi(-order);
            let contours = ruler.ends_above(&[(0.0, high), (0.0, 20.0 * high)]);
            for end in &contours {
                let level = part * end;
                let found = area_up_to(&[areas_cut_at(&contours, &entries, ruler)], level);
                let (low, high) = exactly(&entries, level);
                let doubt = 2.0 * FEW_OPERATIONS * total;
                prop_assert!(found.lower() <= low + doubt && high <= found.upper() + doubt, "{found:?} {low} {high}");
            }
            // Each entry by itself. A function that is negative is rounded by a part of its greatest magnitude.
            for entry in entries.iter().filter(|entry| entry.lower().iter().all(|x| *x >= 0.0)) {
                let level = 2.0 * part * high;
                let beside = 4.0 * MOST_MOVED * high + FLOOR;
                let found = area_up_to(&[areas_cut_at(&contours, &[*entry], ruler)], level);
                let (low, most) = (exactly(&[*entry], level - beside).0, exactly(&[*entry], level + beside).1);
                prop_assert!(low * (1.0 - 1e-9) <= found.lower() && found.upper() <= most * (1.0 + 1e-9) + 1e-20, "{found:?} {low} {most}");
            }
        }

        /// Sums do not depend on who adds what, nor on the order.
        #[test]
        fn parts_add_up_to_the_same_bits(entries in entries(), count in 1..20_usize) {
            let one = areas(&entries, ruler(10.0));
            let mut parts = vec![Grids::new(ruler(10.0)); count];
            for (i, entry) in entries.iter().enumerate().rev() {
                parts[i % count].add(entry);
            }
            let mut all = Grids::new(ruler(10.0));
            for part in parts {
                all.plus(part);
            }
            let all = all.areas();
            prop_assert_eq!(one.sides, all.sides);
            prop_assert_eq!(one.triangles, all.triangles);
        }
    }
}
