//! The triangles that statistics are made of, and sums over them, rounded outwards.

use super::linear::{
    Corners, greater, greatest, least, lesser, mean, mean_enclosure, mean_of_positive, mean_square_enclosure,
    mean_square_of_positive,
};
use super::polygon::Polygon;
use pompeiu_core::exact::Interval;

/// Factors that outweigh the rounding of a few products.
pub(super) const MORE: f64 = 1.0 + 8.0 * f64::EPSILON;
pub(super) const LESS: f64 = 1.0 - 8.0 * f64::EPSILON;

/// A triangle of a piece as statistics see it: the distance lies between two linear functions with these values at the corners. The one
/// above is given by how much greater it is; it and the area are stored so that they are not rounded the wrong way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) lower: Corners,
    pub(super) width: [f32; 3],
    /// The area is at least this, and at most `more` greater.
    pub(super) area: f64,
    pub(super) more: f32,
}

impl Entry {
    /// An area in these bounds whose distances lie between two ends, neither of which is negative.
    pub(super) fn constant((low, high): (f64, f64), (nearest, farthest): (f64, f64)) -> Self {
        let (lower, width) = between(nearest, farthest);
        Self { lower: [lower; 3], width: [width; 3], area: low, more: at_least(high - low, high) }
    }

    /// A triangle of the fan of a polygon, of a face with an area in these bounds.
    pub(super) fn new(polygon: &Polygon, triangle: [usize; 3], (low, high): (f64, f64)) -> Self {
        // A function that is positive nowhere says no more than zero, which does not cost the one above digits.
        let is_above_zero = triangle.iter().any(|j| polygon.lower[*j] > 0.0);
        let lower = |j: usize| if is_above_zero { polygon.lower[j] } else { 0.0 };
        let ends = triangle.map(|j| between(lower(j), polygon.upper[j]));
        let (share, error) = (polygon.outline.share_of(triangle), polygon.outline.share_error());
        let area = greater((share - error) * low * LESS, 0.0);
        let most = (share + error) * high * MORE + f64::MIN_POSITIVE;
        Self {
            lower: ends.map(|(lower, _)| lower),
            width: ends.map(|(_, width)| width),
            area,
            more: at_least(most - area, most),
        }
    }

    pub(super) fn lower(&self) -> Corners {
        self.lower
    }

    /// The sum is rounded once, relative to itself; it is not negative, so the factor makes up for it.
    #[inline]
    pub(super) fn upper(&self) -> Corners {
        let at = |j: usize| (self.lower[j] + f64::from(self.width[j])) * MORE;
        [at(0), at(1), at(2)]
    }

    /// The area from below and from above.
    pub(super) fn area(&self) -> (f64, f64) {
        (self.area, (self.area + f64::from(self.more)) * MORE)
    }

    /// Area times mean width, where the function below is not negative, rounded: as sums have it.
    pub(super) fn mass(&self) -> f64 {
        let [x, y, z] = self.width.map(f64::from);
        let width = (x + y + z) * (1.0 / 3.0);
        if least(self.lower) >= 0.0 {
            return self.area * width;
        }
        self.area * (width + mean(self.lower) - mean_of_positive(self.lower))
    }

    /// The greatest width between the functions, where the one below is not negative, is no greater.
    pub(super) fn most_width(&self) -> f64 {
        lesser(greatest(self.width.map(f64::from)), greatest(self.upper()))
    }
}

/// A difference rounded up to fewer digits: at least the exact one, which is off by no more than the last digit of what it was
/// taken from.
pub(super) fn at_least(difference: f64, from: f64) -> f32 {
    let wanted = difference + f64::EPSILON * (difference.abs() + from.abs());
    if wanted > SMALL {
        // Without a branch that half of all numbers take.
        return (wanted * (1.0 + STEP)) as f32;
    }
    let rounded = wanted as f32;
    if f64::from(rounded) < wanted { rounded.next_up() } else { rounded }
}

/// A lower end and a width for values at a corner. Where the lower one is negative it is what gives way to the rounding of the width: far below zero
/// that is more than an upper one of almost zero, while it hardly lowers the function where it is positive.
fn between(lower: f64, upper: f64) -> (f64, f32) {
    let width = at_least(upper - lower, upper);
    if lower < 0.0 {
        // No less than the exact difference, so that the sum is no less than the upper end.
        (lesser((upper - f64::from(width)).next_up(), lower), width)
    } else {
        (lower, width)
    }
}

/// Rounding to fewer digits takes less than this part of a number whose magnitude is no less than [`SMALL`].
pub(super) const STEP: f64 = 1.0 / (1 << 23) as f64;
pub(super) const SMALL: f64 = 1e-30;

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

    /// Of so many numbers that were summed up.
    pub(super) fn of(lower: f64, upper: f64, terms: f64) -> Self {
        Self { lower, upper, terms }
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
    pub(super) fn of(entries: impl Iterator<Item = Entry>) -> Self {
        let mut sums = Self::default();
        for entry in entries {
            sums.include(&entry);
        }
        sums
    }

    /// Adds an entry, and returns bounds on the integral of its distance.
    pub(super) fn include(&mut self, entry: &Entry) -> (f64, f64) {
        let (low, high) = entry.area();
        let (lower, upper) = (entry.lower(), entry.upper());
        self.area.add(low, high);
        let (below, above) = mean_of(lower, upper);
        let first = (low * below * LESS, high * above * MORE);
        self.first.add(first.0, first.1);
        let above = mean_square_enclosure(upper).upper();
        self.second.add(low * mean_square_of_positive(lower) * LESS, high * above * MORE);
        first
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
