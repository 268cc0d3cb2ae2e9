//! Planes of symmetry, and how people write them.

use pompeiu_core::request::values::tuple;
use std::fmt;
use std::str::FromStr;

/// A plane of symmetry: all points p with normal · p = offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "PlaneValue", into = "PlaneValue"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "PlaneValue"))]
pub struct SymmetryPlane {
    /// A normal vector of the plane, of any length.
    pub normal: [f64; 3],
    /// The product of the normal with a point of the plane.
    pub offset: f64,
}

/// x, y or z for the plane across that axis through the origin, x=C through C, or the four numbers NX,NY,NZ,D.
impl FromStr for SymmetryPlane {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, offset) = text.split_once('=').unwrap_or((text, "0"));
        if let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) {
            let mut normal = [0.0; 3];
            normal[axis] = 1.0;
            let [offset] = tuple::<1>(offset)?;
            return Ok(Self { normal, offset });
        }
        let numbers = tuple::<4>(text).map_err(|_| {
            format!("`{text}` is no plane; expected x, y, z, x=C or the four numbers NX,NY,NZ,D")
        })?;
        Ok(numbers.into())
    }
}

impl From<[f64; 4]> for SymmetryPlane {
    fn from([x, y, z, offset]: [f64; 4]) -> Self {
        Self { normal: [x, y, z], offset }
    }
}

impl From<SymmetryPlane> for [f64; 4] {
    fn from(SymmetryPlane { normal: [x, y, z], offset }: SymmetryPlane) -> Self {
        [x, y, z, offset]
    }
}

impl fmt::Display for SymmetryPlane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.normal;
        write!(f, "{x},{y},{z},{}", self.offset)
    }
}

/// A plane in a file or a dictionary: its text, or its four numbers. It is written as numbers.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected a plane: \"x\", \"y\", \"z\", \"x=C\" or four numbers NX, NY, NZ, D")]
enum PlaneValue {
    /// x, y, z, x=C or NX,NY,NZ,D.
    Text(String),
    /// The components of the normal, and its product with a point of the plane.
    Numbers([f64; 4]),
}

#[cfg(feature = "serde")]
impl TryFrom<PlaneValue> for SymmetryPlane {
    type Error = String;

    fn try_from(value: PlaneValue) -> Result<Self, String> {
        match value {
            PlaneValue::Text(text) => text.parse(),
            PlaneValue::Numbers(numbers) => Ok(numbers.into()),
        }
    }
}

#[cfg(feature = "serde")]
impl From<SymmetryPlane> for PlaneValue {
    fn from(plane: SymmetryPlane) -> Self {
        Self::Numbers(plane.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_named_or_given_by_numbers() {
        let expected = |normal, offset| Ok(SymmetryPlane { normal, offset });
        assert_eq!("y".parse(), expected([0.0, 1.0, 0.0], 0.0));
        assert_eq!("x=-0.5".parse(), expected([1.0, 0.0, 0.0], -0.5));
        assert_eq!("0,3,4,-2".parse(), expected([0.0, 3.0, 4.0], -2.0));
        for wrong in ["", "w", "x=", "x=a", "1,2,3", "1,2,3,4,5"] {
            assert!(wrong.parse::<SymmetryPlane>().is_err(), "{wrong}");
        }
    }
}
