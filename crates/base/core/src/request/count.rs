//! Numbers of things, or shares of those there are, as options take them.

use std::fmt;
use std::str::FromStr;

/// What a share is written with.
const PERCENT: char = '%';

/// A count that is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "expected a number such as 1000, or a share of those there are, above 0 and at most 100%, such as 10%"
)]
pub struct CountError;

/// A number of things, such as `1000`, or a percentage of those there are, such as `10%`.
///
/// It is written as a number, or as text with the sign.
///
/// # Example
/// ```
/// use pompeiu_core::request::Count;
///
/// assert_eq!("1000".parse::<Count>()?.of(5040), 1000);
/// assert_eq!("10 %".parse::<Count>()?.of(5040), 504);
/// # Ok::<(), pompeiu_core::request::CountError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count(Written);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Written {
    Number(usize),
    /// Above 0 and at most 100.
    Percent(f64),
}

impl Count {
    /// A percentage of those there are.
    ///
    /// # Errors
    /// [`CountError`] unless it is above 0 and at most 100.
    pub fn percent(value: f64) -> Result<Self, CountError> {
        if value > 0.0 && value <= 100.0 { Ok(Self(Written::Percent(value))) } else { Err(CountError) }
    }

    /// The number, where there are so many; shares are rounded to the nearest number, and to 1 at least.
    pub fn of(self, all: usize) -> usize {
        match self.0 {
            Written::Number(number) => number,
            Written::Percent(percent) => ((0.01 * percent * all as f64).round() as usize).max(1),
        }
    }
}

impl From<usize> for Count {
    fn from(number: usize) -> Self {
        Self(Written::Number(number))
    }
}

impl FromStr for Count {
    type Err = CountError;

    fn from_str(text: &str) -> Result<Self, CountError> {
        let text = text.trim();
        match text.strip_suffix(PERCENT) {
            Some(share) => share.trim().parse().map_err(|_| CountError).and_then(Self::percent),
            None => text.parse::<usize>().map(Self::from).map_err(|_| CountError),
        }
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Written::Number(number) => number.fmt(f),
            Written::Percent(percent) => write!(f, "{percent}{PERCENT}"),
        }
    }
}

#[cfg(feature = "serde")]
mod data {
    use super::{Count, Written};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a number such as 1000, or text such as 10%")]
    enum Read {
        Number(usize),
        Text(String),
    }

    impl Serialize for Count {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            match self.0 {
                Written::Number(number) => number.serialize(serializer),
                Written::Percent(_) => serializer.collect_str(self),
            }
        }
    }

    impl<'de> Deserialize<'de> for Count {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            match Read::deserialize(deserializer)? {
                Read::Number(number) => Ok(number.into()),
                Read::Text(text) => text.parse().map_err(D::Error::custom),
            }
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Count {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Count".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": ["integer", "string"], "minimum": 0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_shares_are_parsed_or_explained() {
        let of = |text: &str, all| text.parse::<Count>().map(|count| count.of(all));
        assert_eq!((of("0", 9), of(" 12 ", 9), of("100%", 9), of("50 %", 9)), (Ok(0), Ok(12), Ok(9), Ok(5)));
        assert_eq!(of("0.1%", 9), Ok(1), "a share of something is something");
        for wrong in ["", "%", "-1", "1.5", "0%", "101%", "NaN%", "10percent", "1e3"] {
            assert_eq!(of(wrong, 9), Err(CountError), "{wrong}");
        }
        let share: Count = "2.5%".parse().unwrap();
        assert_eq!((share.to_string(), Count::from(7).to_string()), ("2.5%".to_owned(), "7".to_owned()));
    }

    #[cfg(feature = "serde")]
    #[test]
    fn they_are_read_as_they_are_written() {
        use serde::Deserialize;
        use serde::de::IntoDeserializer;
        use serde::de::value::Error;
        let text = |text: &str| Count::deserialize(IntoDeserializer::<Error>::into_deserializer(text));
        assert_eq!(text("10%").unwrap(), Count::percent(10.0).unwrap());
        assert!(text("ten").unwrap_err().to_string().contains("such as 10%"));
        let number = Count::deserialize(IntoDeserializer::<Error>::into_deserializer(5_u64));
        assert_eq!(number.unwrap(), Count::from(5));
    }
}
