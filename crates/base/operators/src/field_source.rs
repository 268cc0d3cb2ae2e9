//! Tangent fields by their names.

use crate::{
    ExpressionError, FaceField, OperatorError, gradient, random_field, rotation_field, tangent_field,
    vertex_values,
};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_core::request::values::direction;
use pompeiu_surface::EmbeddedSurface;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Vectors count as tangent when no part along a normal is longer than this times the longest vector: files in single precision
/// have such parts.
const NORMAL_PART: f64 = 1e-5;

/// The source of a tangent field. As text: a path, `rotation:AXIS`, `gradient:WHAT`, `random:SEED` or `harmonic:K`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "FieldValue", into = "FieldValue"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "FieldValue"))]
pub enum FieldSource {
    /// Vectors on faces in a file.
    File(PathBuf),
    /// The rotation about an axis through the origin; its length is the angular velocity.
    Rotation([f64; 3]),
    /// The gradient of a coordinate, of a linear function given by a direction, or of an expression in x, y and z.
    Gradient(String),
    /// Random vectors, the same for the same seed.
    Random(u64),
    /// The harmonic field with this number, from 0.
    Harmonic(usize),
    /// A vector in space for each face.
    Vectors(Vec<[f64; 3]>),
}

/// A field in a file or a dictionary: its name, or a vector for each face.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected the name of a field, or three numbers for each face")]
enum FieldValue {
    /// A path, rotation:AXIS, gradient:WHAT, random:SEED or harmonic:K.
    Text(String),
    /// Vectors.
    Vectors(Vec<[f64; 3]>),
}

#[cfg(feature = "serde")]
impl TryFrom<FieldValue> for FieldSource {
    type Error = String;

    fn try_from(value: FieldValue) -> Result<Self, String> {
        match value {
            FieldValue::Text(text) => text.parse(),
            FieldValue::Vectors(vectors) => Ok(Self::Vectors(vectors)),
        }
    }
}

#[cfg(feature = "serde")]
impl From<FieldSource> for FieldValue {
    fn from(source: FieldSource) -> Self {
        match source {
            FieldSource::Vectors(vectors) => Self::Vectors(vectors),
            named => Self::Text(named.to_string()),
        }
    }
}

/// What comes before the colon decides; any other text is a path.
impl FromStr for FieldSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let of = |error: &str| format!("{text}: {error}");
        Ok(match text.split_once(':') {
            Some(("rotation", axis)) => Self::Rotation(direction(axis).map_err(|error| of(&error))?),
            Some(("gradient", function)) => Self::Gradient(function.to_owned()),
            Some(("random", seed)) => {
                Self::Random(seed.parse().map_err(|_| of("expected a whole number that is not negative"))?)
            }
            Some(("harmonic", index)) => Self::Harmonic(
                index.parse().map_err(|_| of("expected the number of a harmonic field, from 0"))?,
            ),
            _ => Self::File(text.into()),
        })
    }
}

impl fmt::Display for FieldSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Rotation([x, y, z]) => write!(f, "rotation:{x},{y},{z}"),
            Self::Gradient(function) => write!(f, "gradient:{function}"),
            Self::Random(seed) => write!(f, "random:{seed}"),
            Self::Harmonic(index) => write!(f, "harmonic:{index}"),
            Self::Vectors(vectors) => write!(f, "{} vectors", vectors.len()),
        }
    }
}

/// Why there is no field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldSourceError {
    /// The expression has no values.
    #[error("gradient:{expression}: {error}")]
    Expression {
        /// The expression.
        expression: String,
        /// What is wrong.
        error: ExpressionError,
    },
    /// There is no harmonic field with this number.
    #[error(
        "harmonic:{index}: this surface has {}",
        if *dimension == 0 { "no harmonic fields".to_owned() } else { format!("{dimension} harmonic fields, numbered from 0") }
    )]
    Harmonic {
        /// The number.
        index: usize,
        /// How many there are.
        dimension: usize,
    },
    /// There are too many or too few vectors.
    #[error("found {found} vectors, expected {expected}, one for each face of the mesh")]
    Length {
        /// How many there are.
        found: usize,
        /// Number of faces.
        expected: usize,
    },
    /// A vector is not finite.
    #[error("the vector of face {face} is ({}, {}, {}), expected finite numbers", vector[0], vector[1], vector[2])]
    NotFinite {
        /// The face.
        face: FaceId,
        /// The vector.
        vector: [f64; 3],
    },
    /// A file is named, but its vectors were not handed over.
    #[error("{}: the vectors of this file were not read", path.display())]
    NotRead {
        /// The file.
        path: PathBuf,
    },
    /// The gradient cannot be computed.
    #[error(transparent)]
    Operator(#[from] OperatorError),
}

/// A field, and what was left out of the vectors that it was made of.
#[derive(Clone, Debug)]
pub struct SourcedField {
    /// The tangent field.
    pub field: FaceField,
    /// Length of the longest part of a vector along the normal, which was left out.
    pub normal_part: f64,
    /// Whether the vectors were tangent, up to what single precision leaves.
    pub is_tangent: bool,
}

impl FieldSource {
    /// The file whose vectors [`Self::field`] needs, if it is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }

    /// The field on a surface with these harmonic fields; `read` are the vectors of the file, if it is one.
    ///
    /// # Errors
    /// [`FieldSourceError`].
    pub fn field(
        &self,
        surface: &EmbeddedSurface,
        harmonic: &[FaceField],
        read: Option<&[[f64; 3]]>,
    ) -> Result<SourcedField, FieldSourceError> {
        let field = match self {
            Self::Rotation(axis) => rotation_field(surface, *axis),
            Self::Gradient(function) => gradient_of(function, surface)?,
            Self::Random(seed) => random_field(surface.mesh(), *seed),
            Self::Harmonic(index) => harmonic
                .get(*index)
                .cloned()
                .ok_or(FieldSourceError::Harmonic { index: *index, dimension: harmonic.len() })?,
            Self::Vectors(vectors) => return of_vectors(vectors, surface),
            Self::File(path) => {
                let read = read.ok_or_else(|| FieldSourceError::NotRead { path: path.clone() })?;
                return of_vectors(read, surface);
            }
        };
        Ok(SourcedField { field, normal_part: 0.0, is_tangent: true })
    }
}

fn gradient_of(function: &str, surface: &EmbeddedSurface) -> Result<FaceField, FieldSourceError> {
    let positions = surface.positions().as_slice();
    let values = match direction(function) {
        Ok([a, b, c]) => positions.iter().map(|[x, y, z]| a * x + b * y + c * z).collect(),
        Err(_) => vertex_values(function, positions)
            .map_err(|error| FieldSourceError::Expression { expression: function.to_owned(), error })?,
    };
    let values = VertexData::from_fn(positions.len(), |v| values[v.0 as usize]);
    Ok(gradient(surface.surface(), &values)?)
}

fn of_vectors(vectors: &[[f64; 3]], surface: &EmbeddedSurface) -> Result<SourcedField, FieldSourceError> {
    if let Some(face) = vectors.iter().position(|u| !u.iter().all(|x| x.is_finite())) {
        return Err(FieldSourceError::NotFinite { face: FaceId(face as u32), vector: vectors[face] });
    }
    let data = FaceData::new(surface.mesh().faces(), vectors.to_vec())
        .map_err(|error| FieldSourceError::Length { found: error.found, expected: error.expected })?;
    let (field, normal_part) = tangent_field(surface, &data);
    let lengths = vectors.iter().map(|u| u.iter().map(|x| x * x).sum::<f64>().sqrt());
    let longest = lengths.fold(0.0, |m, x| if x > m { x } else { m });
    Ok(SourcedField { field, normal_part, is_tangent: normal_part <= NORMAL_PART * longest })
}
