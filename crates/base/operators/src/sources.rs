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
