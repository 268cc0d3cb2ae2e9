//! The field that is to be split.

use super::args::FieldSource;
use crate::numbers::{grouped, plain};
use crate::printer::Printer;
use anyhow::{Context, anyhow, bail};
use exmex::Express;
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{FaceData, VertexData};
use pompeiu::fields::HodgeSolver;
use pompeiu::io::read_face_vectors;
use pompeiu::operators::{FaceField, gradient, random_field, rotation_field, tangent_field};
use pompeiu::surface::EmbeddedSurface;

/// A normal part of a field is worth a warning when it is longer than this times its longest vector; files in single
/// precision have some.
const NORMAL_PART: f64 = 1e-5;

pub(super) fn field(
    source: &FieldSource,
    name: Option<&str>,
    mesh: &TriMesh,
    surface: &EmbeddedSurface,
    solver: &HodgeSolver,
    printer: &Printer,
) -> anyhow::Result<FaceField> {
    let gradient_of =
        |values| Ok(gradient(surface.surface(), &VertexData::new(mesh.positions().len(), values)?)?);
    match source {
        FieldSource::Rotation(axis) => Ok(rotation_field(surface, *axis)),
        FieldSource::LinearGradient([a, b, c]) => {
            gradient_of(mesh.positions().iter().map(|[x, y, z]| a * x + b * y + c * z).collect())
        }
        FieldSource::Gradient(expression) => gradient_of(values(expression, mesh)?),
        FieldSource::Random(seed) => Ok(random_field(surface.mesh(), *seed)),
        FieldSource::Harmonic(index) => {
            let dimension = solver.basis().dimension();
            solver.basis().fields().get(*index).cloned().ok_or_else(|| match dimension {
                0 => anyhow!("--field harmonic:{index}: this surface has no harmonic fields"),
                n => {
                    anyhow!("--field harmonic:{index}: this surface has {n} harmonic fields, numbered from 0")
                }
            })
        }
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

/// The values of an expression in x, y and z at the vertices.
fn values(expression: &str, mesh: &TriMesh) -> anyhow::Result<Vec<f64>> {
    let what = || format!("--field gradient:{expression}");
    let parsed = exmex::parse::<f64>(expression)
        .map_err(|error| anyhow!("not an expression: {error}"))
        .with_context(what)?;
    let axes = parsed
        .var_names()
        .iter()
        .map(|variable| match variable.as_str() {
            "x" => Ok(0),
            "y" => Ok(1),
            "z" => Ok(2),
            other => Err(anyhow!("unknown variable {other}, expected x, y or z")).with_context(what),
        })
        .collect::<anyhow::Result<Vec<usize>>>()?;
    mesh.positions()
        .iter()
        .enumerate()
        .map(|(v, position)| {
            let variables: Vec<f64> = axes.iter().map(|&axis| position[axis]).collect();
            let value = parsed.eval(&variables).map_err(|error| anyhow!("{error}")).with_context(what)?;
            if value.is_finite() {
                Ok(value)
            } else {
                Err(anyhow!("is {value} at vertex {v}, expected finite numbers")).with_context(what)
            }
        })
        .collect()
}
