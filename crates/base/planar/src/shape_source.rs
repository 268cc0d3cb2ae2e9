//! Where a shape comes from.

use crate::silhouette::SilhouetteOptions;
use crate::{DrawnShape, FileError, LeftOut, Outline, OutlineError, Point, Region, read_region, read_shapes};
use std::convert::Infallible;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The source of a shape: a file, or the corners of its outline. As text it is a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(untagged, expecting = "expected the name of a file, or two numbers for each corner")
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ShapeSource {
    /// A picture, a drawing or a list of points.
    File(PathBuf),
    /// Corners, in order.
    Corners(Vec<Point>),
}

impl FromStr for ShapeSource {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self::File(text.into()))
    }
}

impl fmt::Display for ShapeSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Corners(corners) => write!(f, "{} corners", corners.len()),
        }
    }
}

/// Why there is no shape.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// The file cannot be used.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: FileError,
    },
    /// The corners are no outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

impl ShapeSource {
    /// The file, if it comes from one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Corners(_) => None,
        }
    }

    /// The shape, and what is left out of its drawing, see [`read_region`].
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn region(&self, options: &SilhouetteOptions) -> Result<(Region, Vec<LeftOut>), ShapeError> {
        match self {
            Self::File(path) => {
                read_region(path, options).map_err(|error| ShapeError::File { path: path.clone(), error })
            }
            Self::Corners(corners) => {
                Ok((Region { outer: Outline::new(corners.clone())?, holes: Vec::new() }, Vec::new()))
            }
        }
    }

    /// All shapes, see [`read_shapes`].
    ///
    /// # Errors
    /// [`ShapeError`] if none can be used.
    pub fn shapes(
        &self,
        options: &SilhouetteOptions,
    ) -> Result<(Vec<DrawnShape>, Option<LeftOut>), ShapeError> {
        match self {
            Self::File(path) => {
                read_shapes(path, options).map_err(|error| ShapeError::File { path: path.clone(), error })
            }
            Self::Corners(_) => {
                Ok((vec![DrawnShape { name: None, region: Ok(self.region(options)?.0) }], None))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_is_read_or_given() {
        let square = ShapeSource::Corners(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        let region = square.region(&SilhouetteOptions::default());
        assert_eq!(region.map(|(region, _)| region.outer.area()).ok(), Some(4.0));
        let missing: ShapeSource = "missing.svg".parse().unwrap_or_else(|error| match error {});
        let error = missing.region(&SilhouetteOptions::default()).map(|_| ());
        let error = error.map_err(|error| error.to_string());
        assert!(error.is_err_and(|text| text.starts_with("missing.svg: it cannot be read")));
        assert_eq!((square.file(), missing.to_string()), (None, "missing.svg".to_owned()));
    }
}
