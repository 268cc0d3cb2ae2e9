//! Accelerations.

use crate::space::Space;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::{FaceField, add_scaled, gradient, tangent_field};
use pompeiu_surface::EmbeddedSurface;
use pompeiu_surface::plane::{norm, quarter_turn, scale};

/// The tangential part of a vector in space on each face: gravity, wind.
pub fn tangential(surface: &EmbeddedSurface, vector: [f64; 3]) -> FaceField {
    tangent_field(surface, &FaceData::filled(surface.mesh().faces(), vector)).0
}

/// The Coriolis parameter of each face: twice the normal component of the angular velocity of the whole surface.
pub fn coriolis(surface: &EmbeddedSurface, angular_velocity: [f64; 3]) -> FaceData<f64> {
    FaceData::from_fn(surface.mesh().faces(), |face| {
        let normal = surface.frame(face)[2];
        2.0 * (0..3).map(|i| normal[i] * angular_velocity[i]).sum::<f64>()
    })
}

/// Gravity times the weight of the densities.
pub(crate) fn weight<'d>(
    space: &Space<'_>,
    gravity: &FaceField,
    densities: impl Iterator<Item = (f64, &'d VertexData<f64>)>,
    force: &mut FaceField,
) {
    for (weight, values) in densities.filter(|(weight, _)| *weight != 0.0) {
        for (face, f) in gravity.entries() {
            let mean: f64 = space.mesh().face(face).into_iter().map(|v| values[v] / 3.0).sum();
            let pull = scale(weight * mean, *f);
            force[face][0] += pull[0];
            force[face][1] += pull[1];
        }
    }
}

/// Vorticity confinement: an acceleration perpendicular to the gradient of |ω| that strengthens maxima.
///
/// # Source
/// `fedkiw_visual_2001`.
pub(crate) fn confine(space: &Space<'_>, strength: f64, vorticity: &VertexData<f64>, force: &mut FaceField) {
    let sizes = VertexData::from_fn(vorticity.len(), |v| vorticity[v].abs());
    let Ok(slopes) = gradient(space.surface, &sizes) else { return };
    let confining = FaceField::from_fn(slopes.len(), |face| {
        let slope = slopes[face];
        let length = norm(slope);
        let mean: f64 = space.mesh().face(face).into_iter().map(|v| vorticity[v] / 3.0).sum();
        // For n ω × N with N the uphill direction: N rotated clockwise by a quarter turn, times ω.
        let factor = if length > 0.0 { -space.edge_length * mean / length } else { 0.0 };
        scale(factor, quarter_turn(slope))
    });
    add_scaled(force, strength, &confining);
}
