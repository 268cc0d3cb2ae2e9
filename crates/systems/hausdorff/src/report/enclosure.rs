//! An interval that holds a distance.

use std::fmt;

/// `lower <= distance <= upper`, both finite and nonnegative: a crossed or NaN enclosure cannot exist.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Ends"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Enclosure {
    lower: f64,
    upper: f64,
}

/// The ends of an enclosure as they are read, before they are checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Ends {
    lower: f64,
    upper: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Ends> for Enclosure {
    type Error = String;

    fn try_from(Ends { lower, upper }: Ends) -> Result<Self, String> {
        Self::new(lower, upper).ok_or_else(|| format!("{lower} and {upper} are no ends of an enclosure"))
    }
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

/// Numbers below this are shown in full: a unit in a digit of theirs may not be a number.
const SHORTENED_FROM: f64 = 1e-290;

/// `[lower, upper]`, in digits that read back to the same bounds; with a precision (`{:.6}`), in that many digits after
/// the first and with a power of ten, the lower end rounded down and the upper end up, so that what is shown still holds.
impl fmt::Display for Enclosure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(precision) = f.precision() else {
            return write!(f, "[{}, {}]", self.lower, self.upper);
        };
        if 0.0 < self.lower && self.lower < SHORTENED_FROM {
            return write!(f, "[{:e}, {:e}]", self.lower, self.upper);
        }
        // Formatting rounds to nearest: a step of one unit in the last digit shown is enough either way.
        let shown = |x: f64| format!("{x:.precision$e}").parse::<f64>().unwrap_or(x);
        let unit = |x: f64| if x > 0.0 { 10_f64.powf(x.log10().floor() - precision as f64) } else { 0.0 };
        let (mut lower, mut upper) = (self.lower, self.upper);
        if shown(lower) > self.lower {
            lower -= unit(lower);
        }
        if shown(upper) < self.upper {
            upper += unit(upper);
        }
        write!(f, "[{lower:.precision$e}, {upper:.precision$e}]")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shown_encloses_too() {
        let e = |lower, upper| Enclosure::new(lower, upper).unwrap();
        assert_eq!(e(0.25, 0.5).to_string(), "[0.25, 0.5]");
        assert_eq!(format!("{:.2}", e(0.333_333, 0.666_666)), "[3.33e-1, 6.67e-1]");
        assert_eq!(format!("{:.2}", e(0.666_666, 0.777_123)), "[6.66e-1, 7.78e-1]");
        assert_eq!(format!("{:.2}", e(0.0, 0.999_999)), "[0.00e0, 1.00e0]");
        for exponent in -320..300 {
            for digit in [1.0, 1.000_000_1, 4.999_999_9, 9.999_999_9] {
                let x = digit * 10_f64.powi(exponent);
                for precision in 0..8 {
                    let text = format!("{:.precision$}", e(x, x));
                    let ends: Vec<f64> =
                        text[1..text.len() - 1].split(", ").map(|t| t.parse().unwrap()).collect();
                    assert!(ends[0] <= x && x <= ends[1], "{x} {text}");
                }
            }
        }
    }

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
