//! Numbers and bounds in the digits that people need: the same in answers, on pages and on paper.

/// Most significant digits shown to people; doubles carry fifteen through any rounding.
pub const MOST_DIGITS: usize = 15;

/// Digits after the first of a bound shown to people.
const FEW_DIGITS: usize = 3;

/// Least number of digits on which two bounds must agree to be shown as one number.
const AGREED_DIGITS: usize = 6;

/// Two bounds with few digits, rounded away from each other.
pub fn between(lower: f64, upper: f64) -> String {
    if lower == 0.0 {
        return format!("at most {}", outward(upper, true));
    }
    format!("{} to {}", outward(lower, false), outward(upper, true))
}

/// A bound with few digits, not above it, or not below it.
fn outward(x: f64, up: bool) -> String {
    if !x.is_finite() {
        return x.to_string();
    }
    let text = format!("{x:.FEW_DIGITS$e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits: i64 = digits.replace('.', "").parse().unwrap_or(0);
    let exponent = exponent.parse().unwrap_or(0) - FEW_DIGITS.cast_signed();
    let value = |digits: i64| format!("{digits}e{exponent}").parse().unwrap_or(x);
    let nearest: f64 = value(digits);
    let outside = if up { nearest >= x } else { nearest <= x };
    shortest(if outside { nearest } else { value(digits + if up { 1 } else { -1 }) })
}

/// What a value between two bounds is: one number where they agree in six digits, else both.
pub fn brief(lower: f64, upper: f64) -> String {
    briefly_agreed(lower, upper).unwrap_or_else(|| between(lower, upper))
}

/// A share between two bounds in percent, rounded outwards to two decimals.
pub fn percentage(lower: f64, upper: f64) -> String {
    let (lower, upper) = ((lower * 1e4).floor() / 1e2, (upper * 1e4).ceil() / 1e2);
    if lower == upper { format!("{lower} %") } else { format!("{lower} to {upper} %") }
}

/// The shortest decimal that reads back to the same double, as a power of ten where it is far from one.
pub fn shortest(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e15).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// What a value between two bounds is, in digits on which both agree when rounded; `None` if these are too few.
pub fn agreed(lower: f64, upper: f64) -> Option<String> {
    if lower == upper { Some(shortest(lower)) } else { agreed_on(lower, upper, MOST_DIGITS) }
}

/// The same with no more digits than it takes.
pub fn briefly_agreed(lower: f64, upper: f64) -> Option<String> {
    if lower == upper {
        return format!("{lower:.*e}", AGREED_DIGITS - 1).parse().ok().map(shortest);
    }
    agreed_on(lower, upper, AGREED_DIGITS)
}

fn agreed_on(lower: f64, upper: f64, most: usize) -> Option<String> {
    (AGREED_DIGITS..=most).rev().find_map(|digits| {
        let rounded = |x: f64| format!("{:.*e}", digits - 1, x);
        let (below, above) = (rounded(lower), rounded(upper));
        if below == above && lower > 0.0 { below.parse().ok().map(shortest) } else { None }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_certain_digits_are_shown() {
        assert_eq!(agreed(0.5, 0.5).as_deref(), Some("0.5"));
        assert_eq!(agreed(0.1 + 0.2, 0.1 + 0.2).as_deref(), Some("0.30000000000000004"));
        assert_eq!(agreed(0.123_456_1, 0.123_456_2).as_deref(), Some("0.123456"));
        assert_eq!(agreed(5.034_138_250_1e-9, 5.034_138_250_3e-9).as_deref(), Some("5.03413825e-9"));
        assert_eq!(agreed(1.0, 2.0), None);
        assert_eq!(agreed(0.018_3, 0.018_6), None);
        assert_eq!(agreed(1.001_6, 1.003_6), None);
        assert_eq!(agreed(0.0, 1e-300), None);
        assert_eq!(agreed(0.999_999_9, 1.000_000_1).as_deref(), Some("1"));
        assert_eq!(briefly_agreed(0.1 + 0.2, 0.1 + 0.2).as_deref(), Some("0.3"));
        assert_eq!(briefly_agreed(5.034_138_250_1, 5.034_138_250_3).as_deref(), Some("5.03414"));
        assert_eq!(briefly_agreed(1.0, 2.0), None);
        assert_eq!(
            (brief(0.5, 2.0).as_str(), brief(0.123_456_1, 0.123_456_2).as_str()),
            ("0.5 to 2", "0.123456")
        );
    }

    #[test]
    fn bounds_are_rounded_away_from_each_other() {
        assert_eq!(between(0.018_366_3, 0.018_571_9), "0.01836 to 0.01858");
        assert_eq!(between(0.5, 2.0), "0.5 to 2");
        assert_eq!(between(0.0, 3.731_1e-14), "at most 3.732e-14");
        assert_eq!(between(1.0_f64.next_down(), 9.999_9), "0.999 to 10");
        assert_eq!(between(1e-300, 1e300), "1e-300 to 1e300");
        assert_eq!(between(1.0, f64::INFINITY), "1 to inf");
        assert_eq!(
            (percentage(0.5, 0.5).as_str(), percentage(0.123_45, 0.2).as_str()),
            ("50 %", "12.34 to 20 %")
        );
    }
}
