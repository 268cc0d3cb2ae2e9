//! Given fields: rotations, tangent parts of vectors in space, random vectors.

use crate::field::FaceField;
use pompeiu_core::mesh::{FaceData, Random};
use pompeiu_surface::{EmbeddedSurface, SurfaceMesh};

/// The tangent part of the velocity of a rotation about an axis through the origin, at the centroid of each face.
///
/// # Shapes and units
/// `axis` points along the axis; its length is the angular velocity.
pub fn rotation_field(surface: &EmbeddedSurface, axis: [f64; 3]) -> FaceField {
    FaceField::from_fn(surface.mesh().faces(), |face| {
        let centre = surface.centroid(face);
        let velocity = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            axis[j] * centre[k] - axis[k] * centre[j]
        });
        surface.to_tangent(face, velocity)
    })
}

/// The tangent parts of vectors in space, and the length of the longest normal part.
///
/// # Panics
/// If the surface has not as many faces as there are vectors.
pub fn tangent_field(surface: &EmbeddedSurface, vectors: &FaceData<[f64; 3]>) -> (FaceField, f64) {
    assert_eq!(vectors.len(), surface.mesh().faces(), "one vector for each face");
    let mut longest = 0.0;
    let field = FaceField::from_fn(vectors.len(), |face| {
        let [x, y, z] = vectors[face];
        let [a, b, c] = surface.frame(face)[2];
        let normal = (a * x + b * y + c * z).abs();
        if normal > longest {
            longest = normal;
        }
        surface.to_tangent(face, [x, y, z])
    });
    (field, longest)
}

/// Independent vectors, both components uniform in [−1, 1) in the frame of each face; the same for the same seed.
pub fn random_field(mesh: &SurfaceMesh, seed: u64) -> FaceField {
    let mut random = Random::new(seed);
    FaceField::from_fn(mesh.faces(), |_| [random.signed_unit(), random.signed_unit()])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests may panic")]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{grid, icosphere};

    #[test]
    fn rotating_a_plane_about_its_normal_is_tangent_everywhere() {
        let mesh = grid([2.0, 2.0], [3, 3], pompeiu_core::mesh::shapes::Diagonal::Rising).unwrap();
        let surface = EmbeddedSurface::new(&mesh).unwrap();
        for (face, &u) in mesh.face_ids().zip(&rotation_field(&surface, [0.0, 0.0, 2.0])) {
            let corners = mesh.corners(face);
            let [x, y] = [0, 1].map(|i| corners.iter().map(|p| p[i]).sum::<f64>() / 3.0);
            let [a, b, c] = surface.to_space(face, u);
            assert!((a + 2.0 * y).abs() < 1e-14 && (b - 2.0 * x).abs() < 1e-14 && c.abs() < 1e-14);
        }
    }

    #[test]
    fn normal_parts_are_left_out_and_measured() {
        let mesh = icosphere(1.0, 1).unwrap();
        let surface = EmbeddedSurface::new(&mesh).unwrap();
        let field = random_field(surface.mesh(), 4);
        let lifted = FaceData::from_fn(field.len(), |face| {
            let tangent = surface.to_space(face, field[face]);
            let normal = surface.frame(face)[2];
            [0, 1, 2].map(|i| tangent[i] - 3.0 * normal[i])
        });
        let (found, normal) = tangent_field(&surface, &lifted);
        assert!((normal - 3.0).abs() < 1e-14);
        assert!(found.iter().zip(&field).all(|(u, w)| (u[0] - w[0]).abs() + (u[1] - w[1]).abs() < 1e-14));
        assert_eq!(field, random_field(surface.mesh(), 4));
        assert_ne!(field, random_field(surface.mesh(), 5));
    }
}
