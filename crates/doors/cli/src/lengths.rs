//! Lengths with units on the command line.

use anyhow::bail;

/// A unit of length: its names, and its length in nanometres.
const UNITS: [(&[&str], f64); 10] = [
    (&["nm", "nanometre", "nanometres", "nanometer", "nanometers"], 1.0),
    (&["µm", "μm", "um", "micron", "microns", "micrometre", "micrometres", "micrometer", "micrometers"], 1e3),
    (&["mm", "millimetre", "millimetres", "millimeter", "millimeters"], 1e6),
    (&["cm", "centimetre", "centimetres", "centimeter", "centimeters"], 1e7),
    (&["dm", "decimetre", "decimetres", "decimeter", "decimeters"], 1e8),
    (&["m", "metre", "metres", "meter", "meters"], 1e9),
    (&["km", "kilometre", "kilometres", "kilometer", "kilometers"], 1e12),
    (&["mil", "mils", "thou"], 25_400.0),
    (&["in", "inch", "inches", "\""], 25.4e6),
    (&["ft", "foot", "feet", "'"], 304.8e6),
];

/// Nanometres in a unit.
fn nanometres(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(names, _)| names.contains(&unit)).map(|(_, length)| *length)
}

/// A length as it was given: a number, in the unit of the files unless it names its own.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Length {
    value: f64,
    unit: Option<String>,
}

/// A tolerance band as it was given: two lengths, negative for what is missing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Band([Length; 2]);

/// Parses a band, such as `-0.05..0.1` or `-50um..0.1mm`. A unit after the second number holds for the first, too.
pub(crate) fn band(text: &str) -> Result<Band, String> {
    let ends = text.split_once("..").map(|(low, high)| (signed(low), signed(high)));
    let Some((Ok(mut low), Ok(high))) = ends else {
        return Err("expected two lengths with two dots between them, such as -0.05..0.1".to_owned());
    };
    low.unit = low.unit.or_else(|| high.unit.clone());
    Ok(Band([low, high]))
}

impl Band {
    /// Its ends in the unit of the files.
    pub(crate) fn in_unit(&self, files: &str) -> anyhow::Result<[f64; 2]> {
        Ok([self.0[0].in_unit(files)?, self.0[1].in_unit(files)?])
    }
}

/// Parses a length that may be negative.
fn signed(text: &str) -> Result<Length, String> {
    let text = text.trim();
    match text.strip_prefix(['-', '\u{2212}']) {
        Some(size) if size.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            length(size).map(|length| Length { value: -length.value, ..length })
        }
        _ => length(text.strip_prefix('+').unwrap_or(text)),
    }
}

/// Parses a length that is not negative, such as 0.1, `0.1mm` or `2 in`.
pub(crate) fn length(text: &str) -> Result<Length, String> {
    let text = text.trim();
    let is_unit = |c: char| c.is_alphabetic() || c == '"' || c == '\'';
    // What follows the last digit or point: `1e-3` has its letter before one.
    let end = text
        .rfind(|c: char| !is_unit(c))
        .map_or(0, |i| i + text[i..].chars().next().map_or(0, char::len_utf8));
    let (number, unit) = text.split_at(end);
    let unit = Some(unit).filter(|unit| !unit.is_empty());
    let known = unit.is_none_or(|unit| nanometres(unit).is_some());
    match number.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 && known => {
            Ok(Length { value, unit: unit.map(str::to_owned) })
        }
        Ok(_) if !known => Err(format!(
            "`{}` is not a unit of length; expected one such as mm, um, in or m",
            unit.unwrap_or("")
        )),
        _ => Err("expected a finite length that is not negative, such as 0.1 or 0.1mm".to_owned()),
    }
}

impl Length {
    /// The length in the unit of the files, of which `--unit` gives the name.
    pub(crate) fn in_unit(&self, files: &str) -> anyhow::Result<f64> {
        let Some(unit) = &self.unit else { return Ok(self.value) };
        if unit == files {
            return Ok(self.value);
        }
        let Some(own) = nanometres(unit) else { bail!("`{unit}` is not a unit of length") };
        match nanometres(files) {
            Some(theirs) => Ok(self.value * own / theirs),
            None if files.is_empty() => bail!(
                "{}{unit} has a unit, but mesh files have none; say with --unit in which unit the coordinates are, such as --unit mm",
                self.value
            ),
            None => bail!(
                "{}{unit} cannot be converted to `{files}`, which is not a unit of length that is known",
                self.value
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_numbers_with_or_without_a_unit() {
        let of = |text: &str, unit: &str| length(text).unwrap().in_unit(unit).unwrap();
        assert_eq!(
            (of("0.1", ""), of("1e-3", "mm"), of("0.1mm", "mm"), of(" 2 in", "mm")),
            (0.1, 1e-3, 0.1, 50.8)
        );
        assert_eq!((of("1e3um", "mm"), of("50 µm", "mm"), of("1m", "in")), (1.0, 0.05, 1e9 / 25.4e6));
    }

    #[test]
    fn bands_have_two_ends() {
        let of = |text: &str, unit: &str| band(text).map(|band| band.in_unit(unit).unwrap());
        assert_eq!(of("-0.05..0.1", ""), Ok([-0.05, 0.1]));
        assert_eq!(of("-50um .. +0.1mm", "mm"), Ok([-0.05, 0.1]));
        assert_eq!(of("-1..2in", "mm"), Ok([-25.4, 50.8]));
        assert_eq!(of("0..1e-3", ""), Ok([0.0, 1e-3]));
        for wrong in ["", "0.1", "..0.1", "--1..1", "-0.1..", "a..b", "1,2"] {
            assert!(band(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_no_length_or_cannot_be_converted_is_refused() {
        for wrong in ["", "mm", "-1", "nan", "inf", "1e400", "0.1 parsec", "1 2", "--"] {
            assert!(length(wrong).is_err(), "{wrong}");
        }
        assert!(length("0.1mm").unwrap().in_unit("").unwrap_err().to_string().contains("--unit"));
        assert!(length("0.1mm").unwrap().in_unit("voxels").is_err());
    }
}
