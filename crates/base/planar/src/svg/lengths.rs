//! Lengths in attributes.

use crate::Point;

/// User units in each unit of length.
const UNITS: [(&str, f64); 8] = [
    ("px", 1.0),
    ("mm", 96.0 / 25.4),
    ("cm", 96.0 / 2.54),
    ("in", 96.0),
    ("pt", 96.0 / 72.0),
    ("pc", 16.0),
    ("Q", 96.0 / 101.6),
    ("", 1.0),
];

/// What percentages are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// The width of the viewport.
    Width,
    /// Its height.
    Height,
    /// Its diagonal, divided by √2.
    Diagonal,
}

/// A length in user units.
pub(super) fn length(text: &str, of: Of, viewport: Option<Point>) -> Result<f64, String> {
    let text = text.trim();
    let wrong = || format!("`{text}` is not a length in px, mm, cm, in, pt, pc, Q or %");
    let (number, factor) = if let Some(number) = text.strip_suffix('%') {
        let [width, height] = viewport
            .ok_or_else(|| format!("`{text}` is a share of a size that the drawing does not state"))?;
        let whole = match of {
            Of::Width => width,
            Of::Height => height,
            Of::Diagonal => (0.5 * (width * width + height * height)).sqrt(),
        };
        (number, 0.01 * whole)
    } else {
        let (number, factor) = UNITS
            .iter()
            .find_map(|(unit, factor)| Some((text.strip_suffix(unit)?, *factor)))
            .ok_or_else(wrong)?;
        (number, factor)
    };
    match number.trim_end().parse::<f64>() {
        Ok(x) if (x * factor).is_finite() => Ok(x * factor),
        _ => Err(wrong()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_converted_and_shares_are_of_the_viewport() {
        let read = |text| length(text, Of::Width, Some([200.0, 100.0]));
        assert_eq!((read("25.4mm"), read(" 3px "), read("1e1")), (Ok(96.0), Ok(3.0), Ok(10.0)));
        assert_eq!((read("10%"), length("10%", Of::Height, Some([200.0, 100.0]))), (Ok(20.0), Ok(10.0)));
        assert!(length("10%", Of::Width, None).is_err());
        for wrong in ["", "x", "3em", "nan", "1e999", "inf"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
