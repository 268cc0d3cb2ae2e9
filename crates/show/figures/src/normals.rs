//! Normals for smooth shading.

use crate::view::{cross, minus};
use pompeiu_core::TriMesh;

/// One normal per vertex: the sum of the normals of its faces, each of length twice the area of the face.
///
/// Zero where the sum vanishes. They are for shading only: normals of inconsistently oriented faces cancel out, and
/// [`Panel::with_normals`](crate::Panel::with_normals) shades such faces flat.
pub fn vertex_normals(mesh: &TriMesh) -> Vec<[f64; 3]> {
    let mut normals = vec![[0.0; 3]; mesh.positions().len()];
    // Scaled by one power of two, so that products of differences neither overflow nor underflow.
    let positions = mesh.positions().iter().flatten();
    let largest = positions.fold(0.0, |largest: f64, x| if x.abs() > largest { x.abs() } else { largest });
    let unit = if largest > 0.0 { largest } else { 1.0 };
    for face in mesh.face_ids() {
        let [p, q, r] = mesh.corners(face).map(|corner| corner.map(|x| x / unit));
        let normal = cross(minus(q, p), minus(r, p));
        for vertex in mesh.faces()[face.index()] {
            let sum = &mut normals[vertex as usize];
            *sum = std::array::from_fn(|i| sum[i] + normal[i]);
        }
    }
    normals
}
