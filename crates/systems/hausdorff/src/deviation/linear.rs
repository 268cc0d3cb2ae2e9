//! Linear functions on a triangle, by their values at the corners: means, squares and parts below a level, rounded outwards.
//!
//! None of this depends on the shape of the triangle: means are over its area, parts are fractions of it.

use multiversion::multiversion;
use pompeiu_core::exact::Interval;

/// Values at three corners, or the lengths of anything that has three.
pub(super) type Corners = [f64; 3];

/// More than the relative rounding of any of the few operations below added up.
pub(super) const FEW_OPERATIONS: f64 = 16.0 * f64::EPSILON;

pub(super) fn lesser(x: f64, y: f64) -> f64 {
    if y < x { y } else { x }
}

pub(super) fn greater(x: f64, y: f64) -> f64 {
    if y > x { y } else { x }
}

pub(super) fn least(v: Corners) -> f64 {
    lesser(lesser(v[0], v[1]), v[2])
}

pub(super) fn greatest(v: Corners) -> f64 {
    greater(greater(v[0], v[1]), v[2])
}

/// The mean, rounded.
pub(super) fn mean(v: Corners) -> f64 {
    (v[0] + v[1] + v[2]) * (1.0 / 3.0)
}

/// Encloses the mean.
pub(super) fn mean_enclosure(v: Corners) -> Interval {
    let margin = (v[0].abs() + v[1].abs() + v[2].abs()) * FEW_OPERATIONS;
    Interval::spanning(mean(v) - margin, mean(v) + margin)
}

/// A lower bound on the mean of the positive part.
pub(super) fn mean_of_positive(v: Corners) -> f64 {
    let [a, b, c] = ascending(v);
    let positive = if a >= 0.0 {
        (a + b + c) * (1.0 / 3.0)
    } else if b >= 0.0 {
        // Without the negative part, which lies on a triangle at that corner.
        (a + b + c - cut_off(a, b, c) * a) * (1.0 / 3.0)
    } else if c > 0.0 {
        cut_off(c, a, b) * c * (1.0 / 3.0)
    } else {
        return 0.0;
    };
    greater(positive - greatest(v.map(f64::abs)) * FEW_OPERATIONS, 0.0)
}

/// The fraction of the triangle on the side of a corner where a linear function has the sign that it has there; `x` is its value at
/// the corner, the others are of the other sign.
fn cut_off(x: f64, y: f64, z: f64) -> f64 {
    if x == 0.0 { 0.0 } else { (x / (x - y)) * (x / (x - z)) }
}

pub(super) fn ascending([a, b, c]: Corners) -> Corners {
    let (a, b) = (lesser(a, b), greater(a, b));
    let (b, c) = (lesser(b, c), greater(b, c));
    [lesser(a, b), greater(a, b), c]
}

/// Encloses the mean of the square of a function that is nowhere negative.
pub(super) fn mean_square_enclosure([a, b, c]: Corners) -> Interval {
    let square = (a * a + b * b + c * c + a * b + b * c + c * a) * (1.0 / 6.0);
    let margin = square * FEW_OPERATIONS + f64::MIN_POSITIVE;
    Interval::spanning(square - margin, square + margin)
}

/// A lower bound on the mean of the square of the positive part.
pub(super) fn mean_square_of_positive(v: Corners) -> f64 {
    let [a, b, c] = ascending(v);
    let whole = (a * a + b * b + c * c + a * b + b * c + c * a) * (1.0 / 6.0);
    let positive = if a >= 0.0 {
        whole
    } else if b >= 0.0 {
        whole - cut_off(a, b, c) * a * a * (1.0 / 6.0)
    } else if c > 0.0 {
        cut_off(c, a, b) * c * c * (1.0 / 6.0)
    } else {
        return 0.0;
    };
    let largest = greatest(v.map(f64::abs));
    greater(positive - largest * largest * FEW_OPERATIONS, 0.0)
}

/// The fraction of a triangle on which a linear function is at most some level, for many levels.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartUpTo {
    least: f64,
    middle: f64,
    greatest: f64,
    /// Curvatures of the fraction below and above the middle value.
    rising: f64,
    falling: f64,
}

impl PartUpTo {
    #[inline]
    pub(super) fn new(v: Corners) -> Self {
        let [a, b, c] = ascending(v);
        // A product that underflows makes it infinite, which the parts below allow for.
        let curvature = |d: f64| if d > 0.0 { 1.0 / (d * (c - a)) } else { 0.0 };
        Self { least: a, middle: b, greatest: c, rising: curvature(b - a), falling: curvature(c - b) }
    }

    /// The fraction, off by at most [`FEW_OPERATIONS`].
    #[inline]
    fn rounded(&self, level: f64) -> f64 {
        if level >= self.greatest {
            1.0
        } else if level < self.least {
            0.0
        } else if level < self.middle {
            let x = level - self.least;
            (x * self.rising) * x
        } else {
            let x = self.greatest - level;
            1.0 - (x * self.falling) * x
        }
    }

    /// The fraction, rounded down; zero and one are exact.
    #[inline]
    pub(super) fn below(&self, level: f64) -> f64 {
        let part = self.rounded(level);
        if level >= self.greatest {
            1.0
        } else if part > FEW_OPERATIONS && part <= 1.0 + FEW_OPERATIONS {
            part - FEW_OPERATIONS
        } else {
            // Also where values are so close to each other that a curvature overflows.
            0.0
        }
    }

    /// The fraction, rounded up; zero and one are exact.
    #[inline]
    pub(super) fn above(&self, level: f64) -> f64 {
        let part = self.rounded(level);
        if level < self.least {
            0.0
        } else if part + FEW_OPERATIONS < 1.0 {
            part + FEW_OPERATIONS
        } else {
            1.0
        }
    }

    /// Adds the fractions for many levels, times a weight: those rounded up, or those rounded down.
    pub(super) fn add<const N: usize>(&self, up: bool, weight: f64, levels: &[f64; N], sums: &mut [f64; N]) {
        if up {
            add_above(self, weight, levels, sums);
        } else {
            add_below(self, weight, levels, sums);
        }
    }

    /// [`PartUpTo::rounded`] without branches.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must be inlined into the loops over levels to be vectorised")]
    fn chosen(&self, level: f64) -> f64 {
        let (x, y) = (level - self.least, self.greatest - level);
        let (rising, falling) = ((x * self.rising) * x, 1.0 - (y * self.falling) * y);
        if level < self.middle { rising } else { falling }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn add_above<const N: usize>(part: &PartUpTo, weight: f64, levels: &[f64; N], sums: &mut [f64; N]) {
    for (sum, level) in sums.iter_mut().zip(levels) {
        let above = part.chosen(*level) + FEW_OPERATIONS;
        let above = if above < 1.0 { above } else { 1.0 };
        let above = if *level >= part.greatest { 1.0 } else { above };
        *sum += weight * if *level < part.least { 0.0 } else { above };
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn add_below<const N: usize>(part: &PartUpTo, weight: f64, levels: &[f64; N], sums: &mut [f64; N]) {
    for (sum, level) in sums.iter_mut().zip(levels) {
        let below = part.chosen(*level) - FEW_OPERATIONS;
        // Not where values are so close to each other that a curvature overflows.
        let below = if below <= 1.0 { below } else { 0.0 };
        let below = if below > 0.0 { below } else { 0.0 };
        let below = if *level < part.least { 0.0 } else { below };
        *sum += weight * if *level >= part.greatest { 1.0 } else { below };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_testkit::effort::cases;
    use proptest::prelude::*;

    fn part_up_to(v: Corners, level: f64) -> Interval {
        let part = PartUpTo::new(v);
        Interval::spanning(part.below(level), part.above(level))
    }

    /// Means over the centres of `n * n` similar triangles.
    fn by_sampling(v: Corners, f: impl Fn(f64) -> f64) -> f64 {
        let n = 300;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n - i {
                let at = |s: f64, t: f64| {
                    let (s, t) = ((f64::from(i) + s) / f64::from(n), (f64::from(j) + t) / f64::from(n));
                    f(v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]))
                };
                sum += at(1.0 / 3.0, 1.0 / 3.0) + if i + j + 1 < n { at(2.0 / 3.0, 2.0 / 3.0) } else { 0.0 };
            }
        }
        sum / f64::from(n * n)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(100)))]

        #[test]
        fn formulas_agree_with_sampling(v in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], level in -1.0..1.0_f64) {
            let near = |x: Interval, y: f64, slack: f64| (x.lower() - slack..=x.upper() + slack).contains(&y);
            prop_assert!(near(mean_enclosure(v), by_sampling(v, |x| x), 1e-9));
            let positive = v.map(f64::abs);
            prop_assert!(near(mean_square_enclosure(positive), by_sampling(positive, |x| x * x), 1e-4));
            let part = by_sampling(v, |x| if x <= level { 1.0 } else { 0.0 });
            prop_assert!(near(part_up_to(v, level), part, 1e-2), "{part} {:?}", part_up_to(v, level));
            let positive = |x: f64| if x > 0.0 { x } else { 0.0 };
            prop_assert!((mean_of_positive(v) - by_sampling(v, positive)).abs() < 1e-4);
            prop_assert!((mean_square_of_positive(v) - by_sampling(v, |x| positive(x) * x)).abs() < 1e-4);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(400)))]

        /// Many levels at once give what one after the other does, at and beside the values themselves, too.
        #[test]
        fn many_levels_are_as_good_as_one(
            v in prop::array::uniform3(prop_oneof![-1.0..1.0_f64, (-2..3_i32).prop_map(f64::from), Just(1e-300), Just(1.0 + 1e-16)]),
            beside in -2.0..2.0_f64,
        ) {
            let part = PartUpTo::new(v);
            let [a, b, c] = v;
            let levels = [a, b, c, a.next_up(), b.next_down(), 0.5 * (a + b), 0.5 * (b + c), beside];
            let (mut above, mut below) = ([0.0; 8], [0.0; 8]);
            part.add(true, 2.0, &levels, &mut above);
            part.add(false, 2.0, &levels, &mut below);
            prop_assert_eq!(above, levels.map(|level| 2.0 * part.above(level)));
            prop_assert_eq!(below, levels.map(|level| 2.0 * part.below(level)));
        }
    }

    #[test]
    fn parts_of_flat_and_half_flat_functions() {
        let exactly = |v, level, part: f64| {
            let found = part_up_to(v, level);
            assert!(found.lower() <= part && part <= found.upper(), "{v:?} {level} {found:?}");
            assert!(found.upper() - found.lower() < 1e-14);
        };
        exactly([2.0, 2.0, 2.0], 2.0, 1.0);
        exactly([2.0, 2.0, 2.0], 1.999, 0.0);
        exactly([0.0, 0.0, 1.0], 0.0, 0.0);
        exactly([0.0, 0.0, 1.0], 0.5, 0.75);
        exactly([1.0, 0.0, 1.0], 0.5, 0.25);
        exactly([0.0, 1.0, 2.0], 1.0, 0.5);
    }
}
