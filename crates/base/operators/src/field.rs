//! Tangent fields that are constant on each face.

use crate::OperatorError;
use pompeiu_core::FaceId;
use pompeiu_surface::plane::{Vec2, dot, quarter_turn};
use pompeiu_surface::{Surface, SurfaceMesh};

/// One tangent vector per face, each in the frame of its face.
pub type FaceField = Vec<Vec2>;

/// That there is a finite vector for each face.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn check_field(mesh: &SurfaceMesh, field: &[Vec2]) -> Result<(), OperatorError> {
    let (found, expected) = (field.len(), mesh.faces());
    if found != expected {
        return Err(OperatorError::FieldLength { found, expected });
    }
    match field.iter().position(|u| !u.iter().all(|x| x.is_finite())) {
        Some(f) => Err(OperatorError::NonFiniteField { face: FaceId(f as u32), value: field[f] }),
        None => Ok(()),
    }
}

/// That there is one value for each element.
pub(crate) fn check_values(
    element: &'static str,
    values: &[f64],
    expected: usize,
) -> Result<(), OperatorError> {
    let found = values.len();
    if found == expected { Ok(()) } else { Err(OperatorError::ValueLength { element, found, expected }) }
}

/// `⟨u, w⟩`, the integral of the scalar product.
///
/// # Panics
/// If there is not one vector for each face.
pub fn field_inner_product(surface: &Surface, u: &[Vec2], w: &[Vec2]) -> f64 {
    surface.mesh().face_ids().map(|f| surface.face_area(f) * dot(u[f.index()], w[f.index()])).sum()
}

/// `‖u‖`, the root of the integral of the squared length.
///
/// # Panics
/// If there is not one vector for each face.
pub fn field_norm(surface: &Surface, u: &[Vec2]) -> f64 {
    field_inner_product(surface, u, u).sqrt()
}

/// `J u`: each vector turned by a quarter, counter-clockwise.
pub fn rotated(field: &[Vec2]) -> FaceField {
    field.iter().map(|&u| quarter_turn(u)).collect()
}

/// `u − w`.
pub fn difference(u: &[Vec2], w: &[Vec2]) -> FaceField {
    u.iter().zip(w).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect()
}

/// `u += s w`.
pub fn add_scaled(u: &mut [Vec2], s: f64, w: &[Vec2]) {
    for (a, b) in u.iter_mut().zip(w) {
        a[0] += s * b[0];
        a[1] += s * b[1];
    }
}
