//! The number of charts, and how it is written.

use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

/// The number of charts that a surface is divided into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "ChartsValue", into = "ChartsValue"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "ChartsValue"))]
pub enum Charts {
    /// One for each connected component.
    #[default]
    Components,
    /// So many: more where there are more components, fewer where the distortion asked for is reached before or faces are too few.
    Count(NonZeroUsize),
    /// As many as the distortion asked for needs.
    Auto,
}

/// Charts in a file or a dictionary: their number, or a word.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected \"components\", \"auto\" or a number of charts")]
enum ChartsValue {
    /// A number, at least 1.
    Count(NonZeroUsize),
    /// components or auto.
    Text(String),
}

#[cfg(feature = "serde")]
impl TryFrom<ChartsValue> for Charts {
    type Error = String;

    fn try_from(value: ChartsValue) -> Result<Self, String> {
        match value {
            ChartsValue::Count(count) => Ok(Self::Count(count)),
            ChartsValue::Text(text) => text.parse(),
        }
    }
}

#[cfg(feature = "serde")]
impl From<Charts> for ChartsValue {
    fn from(charts: Charts) -> Self {
        match charts {
            Charts::Count(count) => Self::Count(count),
            Charts::Components | Charts::Auto => Self::Text(charts.to_string()),
        }
    }
}

impl FromStr for Charts {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "components" => Ok(Self::Components),
            "auto" => Ok(Self::Auto),
            number => number
                .parse()
                .map(Self::Count)
                .map_err(|_| "expected components, auto or a number of charts".to_owned()),
        }
    }
}

impl fmt::Display for Charts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Components => f.write_str("components"),
            Self::Auto => f.write_str("auto"),
            Self::Count(count) => write!(f, "{count}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_are_read_and_written() {
        for text in ["components", "auto", "7"] {
            assert_eq!(text.parse::<Charts>().unwrap().to_string(), text);
        }
        for wrong in ["", "0", "-1", "many", "1.5"] {
            assert!(wrong.parse::<Charts>().is_err(), "{wrong}");
        }
    }
}
