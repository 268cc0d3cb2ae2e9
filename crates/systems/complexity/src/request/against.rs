//! Rankings to compare with.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The source of a ranking: a file, or the place of each name. As text it is a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(untagged, expecting = "expected the name of a file, or a number for each name")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum RankingSource {
    /// A file with lines `name,place`; heads in its first line are ignored.
    File(PathBuf),
    /// Places by names.
    Places(BTreeMap<String, f64>),
}

impl FromStr for RankingSource {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self::File(text.into()))
    }
}

impl fmt::Display for RankingSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Places(places) => write!(f, "{} places", places.len()),
        }
    }
}

/// Why a ranking cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RankingError {
    /// The file cannot be read as comma-separated values.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: csv::Error,
    },
    /// A line without a place.
    #[error("{}: line {line} has one column; expected a name and a place", path.display())]
    Column {
        /// The file.
        path: PathBuf,
        /// Its number, from 1.
        line: usize,
    },
    /// A name that occurs twice.
    #[error("{}: line {line}: `{name}` is there twice", path.display())]
    Twice {
        /// The file.
        path: PathBuf,
        /// The number of the line, from 1.
        line: usize,
        /// The name.
        name: String,
    },
    /// A place that is no finite number.
    #[error("{}: line {line}: `{place}` is not a number", path.display())]
    Place {
        /// The file.
        path: PathBuf,
        /// The number of the line, from 1.
        line: usize,
        /// What is there.
        place: String,
    },
}

impl RankingSource {
    /// The file, if it comes from one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Places(_) => None,
        }
    }

    /// Names with places.
    ///
    /// # Errors
    /// [`RankingError`] if a file cannot be used.
    pub fn places(&self) -> Result<Vec<(String, f64)>, RankingError> {
        match self {
            Self::File(path) => read(path),
            Self::Places(places) => Ok(places.iter().map(|(name, place)| (name.clone(), *place)).collect()),
        }
    }
}

fn read(path: &Path) -> Result<Vec<(String, f64)>, RankingError> {
    let unusable = |error| RankingError::File { path: path.to_owned(), error };
    let mut reader = csv::ReaderBuilder::new();
    reader.has_headers(false).flexible(true).trim(csv::Trim::All);
    let mut found: Vec<(String, f64)> = Vec::new();
    for (index, record) in reader.from_path(path).map_err(unusable)?.records().enumerate() {
        let record = record.map_err(unusable)?;
        let line = index + 1;
        let (Some(name), Some(place)) = (record.get(0), record.get(1)) else {
            return Err(RankingError::Column { path: path.to_owned(), line });
        };
        match place.parse::<f64>() {
            Ok(place) if place.is_finite() => {
                if found.iter().any(|(known, _)| known == name) {
                    return Err(RankingError::Twice { path: path.to_owned(), line, name: name.to_owned() });
                }
                found.push((name.to_owned(), place));
            }
            _ if index == 0 => (),
            _ => return Err(RankingError::Place { path: path.to_owned(), line, place: place.to_owned() }),
        }
    }
    Ok(found)
}
