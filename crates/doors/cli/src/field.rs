//! Tangent fields as the command line names them.

use crate::expression::values;
use crate::numbers::{direction, grouped, plain};
use crate::printer::Printer;
use anyhow::{anyhow, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{FaceData, VertexData};
use pompeiu::io::read_face_vectors;
use pompeiu::operators::{FaceField, gradient, random_field, rotation_field, tangent_field};
use pompeiu::surface::EmbeddedSurface;
use std::path::{Path, PathBuf};

/// A field as the command line names it.
pub(crate) enum FieldSource {
    File(PathBuf),
    Rotation([f64; 3]),
    LinearGradient([f64; 3]),
    Gradient(String),
    Random(u64),
    Harmonic(usize),
}

impl FieldSource {
    /// The file to read, if it is one.
    pub(crate) fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }

    /// Tells the kinds apart by what comes before the colon; anything else is a file.
    /// `option` is the name it was given by.
    pub(crate) fn parse(text: &str, option: &str) -> anyhow::Result<Self> {
        let Some((kind, rest)) = text.split_once(':') else { return Ok(Self::File(text.into())) };
        Ok(match kind {
            "rotation" => {
                Self::Rotation(direction(rest).map_err(|error| anyhow!("{option} rotation:{rest}: {error}"))?)
            }
            "gradient" => match direction(rest) {
                Ok(direction) => Self::LinearGradient(direction),
                Err(_) => Self::Gradient(rest.to_owned()),
            },
            "random" => Self::Random(rest.parse().map_err(|_| {
                anyhow!("{option} random:{rest}: expected a whole number that is not negative")
            })?),
            "harmonic" => Self::Harmonic(rest.parse().map_err(|_| {
                anyhow!("{option} harmonic:{rest}: expected the number of a harmonic field, from 0")
            })?),
            _ => Self::File(text.into()),
        })
    }
}

/// A normal part of a field is worth a warning when it is longer than this times its longest vector; files in single
/// precision have some.
const NORMAL_PART: f64 = 1e-5;

/// The field of a name on a surface; `option` is what it was given by.
pub(crate) fn field(
    source: &FieldSource,
    option: &str,
    name: Option<&str>,
    mesh: &TriMesh,
    surface: &EmbeddedSurface,
    harmonic: &[FaceField],
    printer: &Printer,
) -> anyhow::Result<FaceField> {
    let gradient_of =
        |values| Ok(gradient(surface.surface(), &VertexData::new(mesh.positions().len(), values)?)?);
    match source {
        FieldSource::Rotation(axis) => Ok(rotation_field(surface, *axis)),
        FieldSource::LinearGradient([a, b, c]) => {
            gradient_of(mesh.positions().iter().map(|[x, y, z]| a * x + b * y + c * z).collect())
        }
        FieldSource::Gradient(expression) => {
            gradient_of(values(expression, &format!("{option} gradient:{expression}"), mesh)?)
        }
        FieldSource::Random(seed) => Ok(random_field(surface.mesh(), *seed)),
        FieldSource::Harmonic(index) => harmonic.get(*index).cloned().ok_or_else(|| match harmonic.len() {
            0 => anyhow!("{option} harmonic:{index}: this surface has no harmonic fields"),
            n => {
                anyhow!("{option} harmonic:{index}: this surface has {n} harmonic fields, numbered from 0")
            }
        }),
        FieldSource::File(path) => {
            crate::files::check_readable(path)?;
            let vectors = read_face_vectors(path, name)?;
            let shown = path.display();
            if vectors.len() != mesh.faces().len() {
                let [found, expected] = [vectors.len(), mesh.faces().len()].map(|n| grouped(n as u64));
                bail!("{shown}: found {found} vectors, expected {expected}, one for each face of the mesh");
            }
            if let Some(face) = vectors.iter().position(|u| !u.iter().all(|x| x.is_finite())) {
                let [x, y, z] = vectors[face];
                bail!("{shown}: the vector of face {face} is ({x}, {y}, {z}), expected finite numbers");
            }
            let vectors = FaceData::new(mesh.faces().len(), vectors)?;
            let (field, normal) = tangent_field(surface, &vectors);
            let longest = vectors.iter().map(|u| u.iter().map(|x| x * x).sum::<f64>().sqrt());
            let longest = longest.fold(0.0, |m, x| if x > m { x } else { m });
            if normal > NORMAL_PART * longest {
                printer.warning(format_args!(
                    "{shown}: vectors are not tangent: a part of length {} along the normal was left out",
                    plain(normal)
                ));
            }
            Ok(field)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_told_apart() {
        let parse = |text: &str| FieldSource::parse(text, "--field");
        assert!(matches!(parse("rotation:z"), Ok(FieldSource::Rotation([0.0, 0.0, 1.0]))));
        assert!(matches!(parse("gradient:0,-1,2"), Ok(FieldSource::LinearGradient([0.0, -1.0, 2.0]))));
        assert!(matches!(parse("gradient:x*y"), Ok(FieldSource::Gradient(_))));
        assert!(matches!(parse("random:7"), Ok(FieldSource::Random(7))));
        assert!(matches!(parse("harmonic:1"), Ok(FieldSource::Harmonic(1))));
        assert!(matches!(parse("wind.csv"), Ok(FieldSource::File(_))));
        assert!(matches!(parse("C:wind.csv"), Ok(FieldSource::File(_))));
        for wrong in ["rotation:w", "rotation:0,0,0", "rotation:1,inf,0", "random:-1", "harmonic:x"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
