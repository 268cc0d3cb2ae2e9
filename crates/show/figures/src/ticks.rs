//! Round numbers along a scale, and their text.

/// Round numbers in a range, with their text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticks {
    /// Values, increasing.
    pub(crate) values: Vec<f64>,
    /// The text of each.
    pub(crate) texts: Vec<String>,
    /// The common factor of the texts: empty, or a power of ten.
    pub(crate) multiplier: String,
}

/// Powers of ten for which numbers are written without a factor: 0.001 to 99,999.
const PLAIN: std::ops::RangeInclusive<i32> = -3..=4;

/// Counts of steps above this may not be exact doubles.
const LARGEST_COUNT: f64 = 1e15;

impl Ticks {
    /// Ticks at the given values.
    pub(crate) fn at(values: &[f64]) -> Self {
        let text = |x: &f64| {
            let plain = *x == 0.0 || (1e-4..1e6).contains(&x.abs());
            signed(&if plain { format!("{x}") } else { format!("{x:e}") })
        };
        Self { values: values.to_vec(), texts: values.iter().map(text).collect(), multiplier: String::new() }
    }

    /// Multiples of 1, 2 or 5 times a power of ten in a range, about `count` of them.
    ///
    /// If the range is too narrow for two distinct round numbers, its lower end is the only tick. The ends must be finite and in
    /// order.
    pub(crate) fn new(low: f64, high: f64, count: usize) -> Self {
        // Halved, so that the width is finite whenever the ends are.
        let width = (0.5 * high - 0.5 * low) / (0.5 * count.max(1) as f64);
        let decade = decade(width);
        let mantissa = width / power(decade);
        // The step closest in ratio to the requested one: the bounds are the square roots of 2, 10 and 50.
        let (factor, decade) = match mantissa {
            m if m < 1.41 => (1.0, decade),
            m if m < 3.16 => (2.0, decade),
            m if m < 7.07 => (5.0, decade),
            _ => (1.0, decade + 1),
        };
        let step = factor * power(decade);
        let [first, last] = [low / step, high / step];
        if !(width > 0.0 && step.is_normal() && first.abs() < LARGEST_COUNT && last.abs() < LARGEST_COUNT) {
            return Self {
                values: vec![low],
                texts: vec![signed(&format!("{low:e}"))],
                multiplier: String::new(),
            };
        }
        // An end that is a multiple up to rounding has a tick.
        let [first, last] = [(first - SLACK).ceil() as i64, (last + SLACK).floor() as i64];
        let counts: Vec<i64> = (first..=last).map(|count| count * factor as i64).collect();
        let values: Vec<f64> = counts.iter().map(|&count| product(count, decade)).collect();
        let top =
            values.iter().fold(0.0, |top: f64, value| if value.abs() > top { value.abs() } else { top });
        let top = self::decade(top);
        let exponent = if PLAIN.contains(&top) || values.iter().all(|&value| value == 0.0) { 0 } else { top };
        let digits = (exponent - decade).clamp(0, 17) as usize;
        let text = |&count: &i64| signed(&format!("{:.digits$}", product(count, decade - exponent)));
        Self { texts: counts.iter().map(text).collect(), values, multiplier: multiplier(exponent) }
    }
}

/// Share of a step by which an end may miss a tick.
const SLACK: f64 = 1e-9;

/// The largest power of ten that is not above a positive number, from its decimal digits.
fn decade(x: f64) -> i32 {
    format!("{x:e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// The double nearest to a power of ten.
fn power(exponent: i32) -> f64 {
    product(1, exponent)
}

/// The double nearest to an integer times a power of ten.
fn product(count: i64, exponent: i32) -> f64 {
    format!("{count}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Uses the typographic minus sign for negative numbers.
fn signed(text: &str) -> String {
    text.replace('-', "−")
}

fn multiplier(exponent: i32) -> String {
    let raised = |character: char| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    match exponent {
        0 => String::new(),
        _ => "×10".chars().chain(exponent.to_string().chars().map(raised)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(low: f64, high: f64, count: usize) -> String {
        let ticks = Ticks::new(low, high, count);
        assert_eq!(ticks.values.len(), ticks.texts.len());
        assert!(ticks.values.windows(2).all(|pair| pair[0] < pair[1]));
        [ticks.texts.join(" "), ticks.multiplier].join(" ").trim_end().to_owned()
    }

    #[test]
    fn numbers_are_round_and_have_like_digits() {
        assert_eq!(texts(0.0, 1.0, 5), "0.0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(texts(0.0, 0.037, 4), "0.00 0.01 0.02 0.03");
        assert_eq!(texts(-0.3, 0.3, 6), "−0.3 −0.2 −0.1 0.0 0.1 0.2 0.3");
        assert_eq!(texts(3.0, 47.0, 5), "10 20 30 40");
        assert_eq!(texts(0.0, 25_000.0, 5), "0 5000 10000 15000 20000 25000");
        assert_eq!(texts(1e6, 1e6 + 1.0, 2), "1.0000000 1.0000005 1.0000010 ×10⁶");
    }

    #[test]
    fn small_and_large_numbers_share_a_power_of_ten() {
        assert_eq!(texts(0.0, 2.5e-7, 5), "0.0 0.5 1.0 1.5 2.0 2.5 ×10⁻⁷");
        assert_eq!(texts(0.0, 9e150, 5), "0 2 4 6 8 ×10¹⁵⁰");
        assert_eq!(texts(-f64::MAX, f64::MAX, 4), "−1 0 1 ×10³⁰⁸");
    }

    #[test]
    fn ranges_that_hold_no_two_numbers_have_one() {
        assert_eq!(texts(0.0, 0.0, 5), "0e0");
        assert_eq!(texts(1.0, 1.0 + f64::EPSILON, 5), "1e0");
        assert_eq!(texts(0.0, f64::from_bits(1), 5), "0e0");
    }
}
