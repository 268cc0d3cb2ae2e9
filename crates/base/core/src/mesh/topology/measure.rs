//! Area and volume.

use crate::geom::{Aabb, Frame};
use crate::mesh::TriMesh;
use rayon::prelude::*;

/// Faces per partial sum; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 1 << 14;

/// Sum of the areas of all faces, in squared length; rounded, infinite beyond the range of `f64`.
///
/// # Cost
/// O(m) time on the threads of the current pool; the same sum for any number of them.
pub fn area(mesh: &TriMesh) -> f64 {
    area_in(mesh, &Aabb::of_faces(mesh))
}

/// The same of a mesh with a known bounding box.
pub(super) fn area_in(mesh: &TriMesh, bounding_box: &Aabb) -> f64 {
    let frame = Frame::of(bounding_box);
    let doubled = sum(mesh, &frame, |corners| {
        let n = doubled_normal(corners);
        (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
    });
    frame.length_out(frame.length_out(doubled / 2.0))
}

/// Signed volume enclosed by the faces, if they enclose one.
pub(super) fn volume(mesh: &TriMesh, bounding_box: &Aabb) -> f64 {
    let frame = Frame::of(bounding_box);
    let sixfold = sum(mesh, &frame, |corners| {
        let (n, p) = (doubled_normal(corners), corners[0]);
        n[0] * p[0] + n[1] * p[1] + n[2] * p[2]
    });
    frame.length_out(frame.length_out(frame.length_out(sixfold / 6.0)))
}

/// The normal of a triangle whose length is twice its area.
fn doubled_normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Sum over all faces of a quantity of their corners in the frame.
fn sum(mesh: &TriMesh, frame: &Frame, quantity: impl Fn([[f64; 3]; 3]) -> f64 + Sync) -> f64 {
    let of_face = |face: &[u32; 3]| quantity(face.map(|v| frame.map(mesh.positions()[v as usize])));
    let sums: Vec<f64> =
        mesh.faces().par_chunks(CHUNK).map(|faces| faces.iter().map(of_face).sum::<f64>()).collect();
    sums.iter().sum()
}
