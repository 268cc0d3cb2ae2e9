//! Tangent fields that are constant on each face.

use crate::OperatorError;
use pompeiu_core::mesh::{ElementData, ElementId, FaceData};
use pompeiu_surface::plane::{Vec2, dot, quarter_turn, scale};
use pompeiu_surface::{Surface, SurfaceMesh};

/// One tangent vector per face, each in the frame of its face.
pub type FaceField = FaceData<Vec2>;

/// Checks that every face has a finite vector.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn check_field(mesh: &SurfaceMesh, field: &FaceField) -> Result<(), OperatorError> {
    let (found, expected) = (field.len(), mesh.faces());
    if found != expected {
        return Err(OperatorError::FieldLength { found, expected });
    }
    match field.entries().find(|(_, u)| !u.iter().all(|x| x.is_finite())) {
        Some((face, &value)) => Err(OperatorError::NonFiniteField { face, value }),
        None => Ok(()),
    }
}

/// Checks that every element has one value.
pub(crate) fn check_values<I: ElementId>(
    values: &ElementData<I, f64>,
    expected: usize,
) -> Result<(), OperatorError> {
    let (element, found) = (I::NAME, values.len());
    if found == expected { Ok(()) } else { Err(OperatorError::ValueLength { element, found, expected }) }
}

/// `⟨u, w⟩`, the integral of the scalar product.
///
/// # Panics
/// If there is not one vector for each face.
pub fn field_inner_product(surface: &Surface, u: &FaceField, w: &FaceField) -> f64 {
    surface.mesh().face_ids().map(|f| surface.face_area(f) * dot(u[f], w[f])).sum()
}

/// `‖u‖`, the root of the integral of the squared length.
///
/// Scales by a power of two where squares would overflow or underflow.
///
/// # Panics
/// If there is not one vector for each face.
pub fn field_norm(surface: &Surface, u: &FaceField) -> f64 {
    /// 2^±256: for components between them, squares times areas neither overflow nor underflow.
    const MODERATE: [f64; 2] = [f64::from_bits((1023 - 256) << 52), f64::from_bits((1023 + 256) << 52)];
    /// 2^±600: factors that bring other components between them.
    const FACTORS: [f64; 2] = [f64::from_bits((1023 - 600) << 52), f64::from_bits((1023 + 600) << 52)];
    let largest = u.as_flattened().iter().fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m });
    let [factor, inverse] = match largest {
        x if x < MODERATE[0] => [FACTORS[1], FACTORS[0]],
        x if x > MODERATE[1] => FACTORS,
        _ => [1.0; 2],
    };
    let square = |u: Vec2| {
        let u = scale(factor, u);
        dot(u, u)
    };
    let sum: f64 = u.entries().map(|(face, &u)| surface.face_area(face) * square(u)).sum();
    sum.sqrt() * inverse
}

/// `J u`: each vector rotated by a quarter turn counter-clockwise.
pub fn rotated(field: &FaceField) -> FaceField {
    field.map(|&u| quarter_turn(u))
}

/// `u − w`.
///
/// # Panics
/// If the two have different numbers of vectors.
pub fn difference(u: &FaceField, w: &FaceField) -> FaceField {
    FaceField::from_fn(u.len(), |f| [u[f][0] - w[f][0], u[f][1] - w[f][1]])
}

/// `u += s w`.
pub fn add_scaled(u: &mut FaceField, s: f64, w: &FaceField) {
    for (a, b) in u.iter_mut().zip(w) {
        a[0] += s * b[0];
        a[1] += s * b[1];
    }
}
