//! An interval that holds a distance.

/// `lower <= distance <= upper`, both finite and nonnegative: a crossed or NaN enclosure cannot exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    lower: f64,
    upper: f64,
}

impl Enclosure {
    /// The enclosure with these ends; none unless `0 <= lower <= upper < infinity`.
    pub fn new(lower: f64, upper: f64) -> Option<Self> {
        (0.0 <= lower && lower <= upper && upper < f64::INFINITY).then_some(Self { lower, upper })
    }

    /// Proven not to exceed the distance.
    pub const fn lower(&self) -> f64 {
        self.lower
    }

    /// Proven not to be exceeded by the distance.
    pub const fn upper(&self) -> f64 {
        self.upper
    }

    /// `upper - lower`, rounded up.
    pub fn gap(&self) -> f64 {
        if self.upper > self.lower { (self.upper - self.lower).next_up() } else { 0.0 }
    }

    /// Whether a value lies inside.
    pub fn contains(&self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }

    /// Encloses the greater of two enclosed values.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        let greater = |x, y| if x > y { x } else { y };
        Self { lower: greater(self.lower, other.lower), upper: greater(self.upper, other.upper) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossed_and_unbounded_enclosures_do_not_exist() {
        for (lower, upper) in
            [(1.0, 0.5), (f64::NAN, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY), (-1.0, 1.0)]
        {
            assert_eq!(Enclosure::new(lower, upper), None);
        }
        let e = Enclosure::new(1.0, 2.0).unwrap();
        assert!(e.contains(1.0) && e.contains(2.0) && !e.contains(2.1) && e.gap() >= 1.0);
        assert_eq!(e.max(Enclosure::new(0.0, 3.0).unwrap()), Enclosure::new(1.0, 3.0).unwrap());
    }
}
