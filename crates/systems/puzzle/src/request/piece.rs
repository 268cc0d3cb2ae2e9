//! The shape of pieces as it is asked for.

use super::PuzzleRequestError;
use crate::{PieceName, PieceShape};
use pompeiu_planar::{Outline, ShapeSource};
use std::convert::Infallible;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// The shape of pieces: the name of a built-in one, or where another one comes from.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "ShapeSource", into = "ShapeSource"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "ShapeSource"))]
pub enum PieceSource {
    /// A built-in shape.
    Built(PieceName),
    /// Another shape.
    Shape(ShapeSource),
}

impl From<ShapeSource> for PieceSource {
    fn from(source: ShapeSource) -> Self {
        let name = source.file().and_then(Path::to_str).and_then(PieceName::named);
        name.map_or(Self::Shape(source), Self::Built)
    }
}

impl From<PieceSource> for ShapeSource {
    fn from(source: PieceSource) -> Self {
        match source {
            PieceSource::Built(name) => Self::File(name.name().into()),
            PieceSource::Shape(source) => source,
        }
    }
}

/// Any text that is no name is a path.
impl FromStr for PieceSource {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(ShapeSource::File(text.into()).into())
    }
}

impl fmt::Display for PieceSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Built(name) => f.write_str(name.name()),
            Self::Shape(source) => source.fmt(f),
        }
    }
}

impl PieceSource {
    /// The file, if it comes from one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::Built(_) => None,
            Self::Shape(source) => source.file(),
        }
    }

    pub(super) fn shape(
        &self,
        whole: impl FnOnce(&ShapeSource) -> Result<Outline, PuzzleRequestError>,
    ) -> Result<PieceShape, PuzzleRequestError> {
        match self {
            Self::Built(name) => Ok(PieceShape::Built(*name)),
            Self::Shape(source) => match whole(source) {
                Ok(outline) => Ok(PieceShape::Outline(outline)),
                // A name without a suffix may be a misspelt one.
                Err(PuzzleRequestError::Shape(error))
                    if self.file().is_some_and(|path| path.extension().is_none()) =>
                {
                    Err(PuzzleRequestError::Piece(error))
                }
                Err(error) => Err(error),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_built_in_and_other_texts_are_files() {
        let read = |text: &str| text.parse::<PieceSource>().unwrap_or_else(|error| match error {});
        assert_eq!(read("bird"), PieceSource::Built(PieceName::Bird));
        assert_eq!(read("fish.png").file(), Some(Path::new("fish.png")));
        assert_eq!(ShapeSource::from(read("star")).to_string(), "star");
    }
}
