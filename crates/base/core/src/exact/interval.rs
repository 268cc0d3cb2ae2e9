//! Closed intervals with outward rounding.

use std::ops::{Add, Mul, Neg, Sub};

/// A closed interval of reals that holds the exact value of what it was computed from.
///
/// # Accuracy
/// Every operation rounds to nearest and then moves both ends outwards to the next double. This encloses the exact result, because
/// rounding to nearest errs by at most half the distance between neighbouring doubles. Overflow gives infinite ends and `0 * inf`
/// gives the whole line, so an interval never becomes NaN.
/// # Source
/// Interval arithmetic: `moore_interval_2009`. We step outwards instead of switching the rounding mode, which makes each result
/// wider by a unit in the last place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// The interval that holds `x` alone; the whole line for NaN.
    pub const fn point(x: f64) -> Self {
        if x.is_nan() { Self::WHOLE } else { Self { lower: x, upper: x } }
    }

    /// The interval between the neighbours of the double `x`: encloses every number that rounds to `x`.
    pub fn around(x: f64) -> Self {
        Self::outward(x, x)
    }

    /// The smallest interval that holds two numbers; the whole line if one of them is NaN.
    pub const fn spanning(x: f64, y: f64) -> Self {
        if x.is_nan() || y.is_nan() {
            Self::WHOLE
        } else if x < y {
            Self { lower: x, upper: y }
        } else {
            Self { lower: y, upper: x }
        }
    }

    /// The whole real line.
    pub const WHOLE: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// Lower end: the value is not less than this.
    pub const fn lower(self) -> f64 {
        self.lower
    }

    /// Upper end: the value is not greater than this.
    pub const fn upper(self) -> f64 {
        self.upper
    }

    /// Encloses the square.
    #[must_use]
    pub fn square(self) -> Self {
        let product = self * self;
        Self { lower: if product.lower > 0.0 { product.lower } else { 0.0 }, upper: product.upper }
    }

    /// Encloses the square root of the nonnegative part.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = |x: f64| if x > 0.0 { x.sqrt() } else { 0.0 };
        let lower = root(self.lower).next_down();
        Self { lower: if lower > 0.0 { lower } else { 0.0 }, upper: root(self.upper).next_up() }
    }

    /// Encloses the quotient by a value that is positive by construction. The result is the whole line if the interval of the
    /// divisor reaches zero or below.
    #[must_use]
    pub fn divide_by_positive(self, divisor: Self) -> Self {
        if divisor.lower <= 0.0 {
            return Self::WHOLE;
        }
        let low = if self.lower >= 0.0 { self.lower / divisor.upper } else { self.lower / divisor.lower };
        let high = if self.upper >= 0.0 { self.upper / divisor.lower } else { self.upper / divisor.upper };
        Self::outward(low, high)
    }

    fn outward(lower: f64, upper: f64) -> Self {
        if lower.is_nan() || upper.is_nan() {
            return Self::WHOLE;
        }
        Self { lower: lower.next_down(), upper: upper.next_up() }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.lower + other.lower, self.upper + other.upper)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.lower - other.upper, self.upper - other.lower)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let products = [
            self.lower * other.lower,
            self.lower * other.upper,
            self.upper * other.lower,
            self.upper * other.upper,
        ];
        if products.iter().any(|x| x.is_nan()) {
            return Self::WHOLE;
        }
        let (mut lower, mut upper) = (products[0], products[0]);
        for x in products {
            lower = if x < lower { x } else { lower };
            upper = if x > upper { x } else { upper };
        }
        Self::outward(lower, upper)
    }
}
