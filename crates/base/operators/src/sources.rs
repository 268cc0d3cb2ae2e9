//! Fields to start from.

use crate::field::FaceField;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Random;
use pompeiu_surface::EmbeddedSurface;
use pompeiu_surface::SurfaceMesh;

/// The velocity of a rotation about an axis through the origin, at the centre of each face, less what is not tangent.
///
/// # Shapes and units
/// `mesh` is the mesh that `surface` was made from; `axis` points along the axis, its length is the angular velocity.
pub fn rotation_field(surface: &EmbeddedSurface, mesh: &TriMesh, axis: [f64; 3]) -> FaceField {
    mesh.face_ids()
        .map(|face| {
            let corners = mesh.corners(face);
            let centre: [f64; 3] = [0, 1, 2].map(|i| corners.iter().map(|p| p[i] / 3.0).sum());
            let velocity = [0, 1, 2].map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                axis[j] * centre[k] - axis[k] * centre[j]
            });
            surface.to_tangent(face, velocity)
        })
        .collect()
}

/// The tangent part of vectors in space, one for each face; and the length of the longest part that is normal.
///
/// # Panics
/// If there is not one vector for each face.
pub fn tangent_field(surface: &EmbeddedSurface, vectors: &[[f64; 3]]) -> (FaceField, f64) {
    let mut longest = 0.0;
    let field = surface
        .mesh()
        .face_ids()
        .map(|face| {
            let [x, y, z] = vectors[face.index()];
            let [a, b, c] = surface.frame(face)[2];
            let normal = (a * x + b * y + c * z).abs();
            if normal > longest {
                longest = normal;
            }
            surface.to_tangent(face, [x, y, z])
        })
        .collect();
    (field, longest)
}

/// Independent vectors, both components uniform in [−1, 1) in the frame of each face; the same for the same seed.
pub fn random_field(mesh: &SurfaceMesh, seed: u64) -> FaceField {
    let mut random = Random::new(seed);
    (0..mesh.faces()).map(|_| [random.signed_unit(), random.signed_unit()]).collect()
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
        for (face, &u) in mesh.face_ids().zip(&rotation_field(&surface, &mesh, [0.0, 0.0, 2.0])) {
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
        let lifted: Vec<[f64; 3]> = mesh
            .face_ids()
            .map(|face| {
                let tangent = surface.to_space(face, field[face.index()]);
                let normal = surface.frame(face)[2];
                [0, 1, 2].map(|i| tangent[i] - 3.0 * normal[i])
            })
            .collect();
        let (found, normal) = tangent_field(&surface, &lifted);
        assert!((normal - 3.0).abs() < 1e-14);
        assert!(found.iter().zip(&field).all(|(u, w)| (u[0] - w[0]).abs() + (u[1] - w[1]).abs() < 1e-14));
        assert_eq!(field, random_field(surface.mesh(), 4));
        assert_ne!(field, random_field(surface.mesh(), 5));
    }
}
