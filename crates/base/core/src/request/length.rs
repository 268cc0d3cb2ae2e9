//! Lengths with units, and bands of lengths, as options take them.

use std::fmt;
use std::str::FromStr;

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

/// What a share of a diagonal is written with.
const PERCENT: &str = "%";

/// Nanometres in a unit.
fn nanometres(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(names, _)| names.contains(&unit)).map(|(_, length)| *length)
}

/// A length that is no length, or cannot be converted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LengthError {
    /// The text or the number is no length.
    #[error("expected a finite length that is not negative, such as 0.1, 0.1mm or 0.5% of the diagonal")]
    Syntax,
    /// The text is no band.
    #[error("expected two lengths with two dots between them, such as -0.05..0.1")]
    Band,
    /// The unit is not known.
    #[error("`{0}` is not a unit of length; expected one such as mm, um, in or m")]
    Unit(String),
    /// The length has a unit, and the unit of the coordinates is not given.
    #[error(
        "{0} has a unit, but mesh files have none; say with --unit in which unit the coordinates are, such as --unit mm"
    )]
    NoUnit(Length),
    /// A percentage where a length is needed.
    #[error("{0} is a share of the size of a mesh; expected a length")]
    Percent(Length),
    /// The unit of the coordinates is no unit of length.
    #[error("{length} cannot be converted to `{unit}`, which is not a unit of length that is known")]
    NotConvertible {
        /// The length.
        length: Length,
        /// The unit of the coordinates.
        unit: String,
    },
}

/// A length as it was given: a number in the unit of the coordinates, a number with a unit, such as `0.1mm`, or a percentage of the diagonal of the box
/// around what is looked at, such as `0.5%`.
///
/// It is written as a number without a unit and as text with one. Of an option it is not negative; the ends of a [`Band`] may be.
///
/// # Example
/// ```
/// use pompeiu_core::request::Length;
///
/// let length: Length = "2 in".parse()?;
/// assert_eq!(length.in_unit("mm")?, 50.8);
/// assert!(length.in_unit("").is_err());
/// # Ok::<(), pompeiu_core::request::LengthError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Length {
    value: f64,
    unit: Option<String>,
}

impl Length {
    /// A length in the unit of the coordinates.
    ///
    /// # Errors
    /// [`LengthError::Syntax`] for a number that is negative or not finite.
    pub fn new(value: f64) -> Result<Self, LengthError> {
        if value.is_finite() && value >= 0.0 {
            Ok(Self { value, unit: None })
        } else {
            Err(LengthError::Syntax)
        }
    }

    /// The length in the unit of the coordinates, of which `unit` is the name; empty where nobody knows.
    ///
    /// # Errors
    /// [`LengthError::NoUnit`] and [`LengthError::NotConvertible`].
    pub fn in_unit(&self, unit: &str) -> Result<f64, LengthError> {
        let Some(own) = &self.unit else { return Ok(self.value) };
        if own == unit {
            return Ok(self.value);
        }
        if own == PERCENT {
            return Err(LengthError::Percent(self.clone()));
        }
        match (nanometres(own), nanometres(unit)) {
            (Some(own), Some(theirs)) => Ok(self.value * own / theirs),
            (None, _) => Err(LengthError::Unit(own.clone())),
            _ if unit.is_empty() => Err(LengthError::NoUnit(self.clone())),
            _ => Err(LengthError::NotConvertible { length: self.clone(), unit: unit.to_owned() }),
        }
    }

    /// The length in the unit of the coordinates, of which `unit` is the name, where percentages are those of a diagonal.
    ///
    /// # Errors
    /// [`LengthError::NoUnit`] and [`LengthError::NotConvertible`].
    pub fn of(&self, unit: &str, diagonal: f64) -> Result<f64, LengthError> {
        match &self.unit {
            Some(own) if own == PERCENT => Ok(0.01 * self.value * diagonal),
            _ => self.in_unit(unit),
        }
    }

    /// Parses a length that may be negative.
    fn signed(text: &str) -> Result<Self, LengthError> {
        let text = text.trim();
        match text.strip_prefix(['-', '\u{2212}']) {
            Some(size) if size.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                size.parse().map(|length: Self| Self { value: -length.value, ..length })
            }
            _ => text.strip_prefix('+').unwrap_or(text).parse(),
        }
    }
}

impl FromStr for Length {
    type Err = LengthError;

    fn from_str(text: &str) -> Result<Self, LengthError> {
        let text = text.trim();
        let is_unit = |c: char| c.is_alphabetic() || matches!(c, '"' | '\'' | '%');
        // What follows the last digit or point: `1e-3` has its letter before one.
        let end = text
            .rfind(|c: char| !is_unit(c))
            .map_or(0, |i| i + text[i..].chars().next().map_or(0, char::len_utf8));
        let (number, unit) = text.split_at(end);
        let unit = Some(unit).filter(|unit| !unit.is_empty());
        let value: f64 = number.trim().parse().map_err(|_| LengthError::Syntax)?;
        if let Some(unit) = unit.filter(|unit| *unit != PERCENT && nanometres(unit).is_none()) {
            return Err(LengthError::Unit(unit.to_owned()));
        }
        Self::new(value).map(|length| Self { unit: unit.map(str::to_owned), ..length })
    }
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.value, self.unit.as_deref().unwrap_or_default())
    }
}

/// A tolerance band: its least and its greatest deviation, negative for what is missing.
///
/// Its text is such as `-0.05..0.1` or `-50um..0.1mm`; a unit after the second number holds for the first, too. It is written as a list of
/// two lengths, and read as either.
#[derive(Clone, Debug, PartialEq)]
pub struct Band([Length; 2]);

impl Band {
    /// Its ends in the unit of the coordinates.
    ///
    /// # Errors
    /// As of [`Length::in_unit`].
    pub fn in_unit(&self, unit: &str) -> Result<[f64; 2], LengthError> {
        Ok([self.0[0].in_unit(unit)?, self.0[1].in_unit(unit)?])
    }
}

impl FromStr for Band {
    type Err = LengthError;

    fn from_str(text: &str) -> Result<Self, LengthError> {
        let ends = text.split_once("..").map(|(low, high)| (Length::signed(low), Length::signed(high)));
        let Some((Ok(mut low), Ok(high))) = ends else { return Err(LengthError::Band) };
        low.unit = low.unit.or_else(|| high.unit.clone());
        Ok(Self([low, high]))
    }
}

impl fmt::Display for Band {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.0[0], self.0[1])
    }
}

#[cfg(feature = "serde")]
mod data {
    use super::{Band, Length};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// A length as it is written.
    #[derive(Serialize, Deserialize)]
    #[serde(untagged, expecting = "expected a length: a number, or text such as 0.1mm or 0.5%")]
    enum Written {
        Number(f64),
        Text(String),
    }

    /// A band as it is written.
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a tolerance band: two lengths, or text such as -0.05..0.1")]
    enum WrittenBand {
        Ends([Written; 2]),
        Text(String),
    }

    impl Serialize for Length {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            match self.unit {
                Some(_) => serializer.serialize_str(&self.to_string()),
                None => serializer.serialize_f64(self.value),
            }
        }
    }

    impl<'de> Deserialize<'de> for Length {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            match Written::deserialize(deserializer)? {
                Written::Number(value) => Self::new(value).map_err(D::Error::custom),
                Written::Text(text) => text.parse().map_err(D::Error::custom),
            }
        }
    }

    impl Serialize for Band {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            self.0.serialize(serializer)
        }
    }

    impl<'de> Deserialize<'de> for Band {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let end = |written| match written {
                Written::Number(value) => Ok(Length { value, unit: None }),
                Written::Text(text) => Length::signed(&text).map_err(D::Error::custom),
            };
            match WrittenBand::deserialize(deserializer)? {
                WrittenBand::Ends([low, high]) => Ok(Self([end(low)?, end(high)?])),
                WrittenBand::Text(text) => text.parse().map_err(D::Error::custom),
            }
        }
    }
}

#[cfg(feature = "schema")]
mod schema {
    use super::{Band, Length};
    use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
    use std::borrow::Cow;

    impl JsonSchema for Length {
        fn inline_schema() -> bool {
            true
        }

        fn schema_name() -> Cow<'static, str> {
            "Length".into()
        }

        fn json_schema(_: &mut SchemaGenerator) -> Schema {
            json_schema!({ "type": ["number", "string"] })
        }
    }

    impl JsonSchema for Band {
        fn inline_schema() -> bool {
            true
        }

        fn schema_name() -> Cow<'static, str> {
            "Band".into()
        }

        fn json_schema(generator: &mut SchemaGenerator) -> Schema {
            <[Length; 2]>::json_schema(generator)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str, unit: &str) -> f64 {
        text.parse::<Length>().unwrap().in_unit(unit).unwrap()
    }

    #[test]
    fn lengths_are_numbers_with_or_without_a_unit() {
        assert_eq!(
            (of("0.1", ""), of("1e-3", "mm"), of("0.1mm", "mm"), of(" 2 in", "mm")),
            (0.1, 1e-3, 0.1, 50.8)
        );
        assert_eq!((of("1e3um", "mm"), of("50 µm", "mm"), of("1m", "in")), (1.0, 0.05, 1e9 / 25.4e6));
    }

    #[test]
    fn bands_have_two_ends() {
        let of = |text: &str, unit: &str| text.parse::<Band>().map(|band| band.in_unit(unit).unwrap());
        assert_eq!(of("-0.05..0.1", ""), Ok([-0.05, 0.1]));
        assert_eq!(of("-50um .. +0.1mm", "mm"), Ok([-0.05, 0.1]));
        assert_eq!(of("-1..2in", "mm"), Ok([-25.4, 50.8]));
        assert_eq!(of("0..1e-3", ""), Ok([0.0, 1e-3]));
        for wrong in ["", "0.1", "..0.1", "--1..1", "-0.1..", "a..b", "1,2"] {
            assert!(of(wrong, "").is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_no_length_or_cannot_be_converted_is_refused() {
        for wrong in ["", "mm", "-1", "nan", "inf", "1e400", "0.1 parsec", "1 2", "--"] {
            assert!(wrong.parse::<Length>().is_err(), "{wrong}");
        }
        let share: Length = "0.5 %".parse().unwrap();
        assert!(
            share.in_unit("mm").is_err() && share.of("", 200.0) == Ok(1.0) && share.to_string() == "0.5%"
        );
        let millimetre: Length = "0.1mm".parse().unwrap();
        assert_eq!(millimetre.of("um", 9.0), Ok(100.0));
        assert!(millimetre.in_unit("").unwrap_err().to_string().contains("--unit"));
        assert!(millimetre.in_unit("voxels").is_err());
    }

    /// A number or text, read back as it was.
    #[cfg(feature = "serde")]
    #[test]
    fn lengths_and_bands_are_data() {
        use serde::Deserialize;
        use serde::de::IntoDeserializer;
        use serde::de::value::{Error, F64Deserializer, StrDeserializer};
        let number = |x: f64| -> Result<Length, Error> {
            let data: F64Deserializer<Error> = x.into_deserializer();
            Length::deserialize(data)
        };
        let text = |text: &str| -> Result<Length, Error> {
            let data: StrDeserializer<'_, Error> = text.into_deserializer();
            Length::deserialize(data)
        };
        assert_eq!(number(0.5).unwrap(), Length::new(0.5).unwrap());
        assert_eq!(text("0.1mm").unwrap(), "0.1 mm".parse().unwrap());
        assert!(number(-1.0).unwrap_err().to_string().contains("not negative"));
        assert!(text("0.1 parsec").unwrap_err().to_string().contains("parsec"));
        let data: StrDeserializer<'_, Error> = "-1..2in".into_deserializer();
        assert_eq!(Band::deserialize(data).unwrap().to_string(), "-1in..2in");
    }
}
