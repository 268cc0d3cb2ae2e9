//! Curvature of a mesh at its vertices, from the angles between its faces.

use super::connectivity::{DynamicMesh, NONE};
use super::marked::{Hold, Marked};
use super::quadric::eigenvalues;
use rayon::prelude::*;

/// A sum over edges and the area around: xx, xy, xz, yy, yz, zz of the tensor, then the area.
type Measure = [f64; 7];

/// The larger principal curvature at each vertex, in magnitude; some halfedges may be left out, as if the surface were flat across them.
///
/// # Definition
/// Each edge turns the surface by the angle between its faces, about itself. The tensor of a vertex is the sum of
/// `angle × length × e eᵀ` over edges, half of each at either end, divided by the area, a third of each face; both are summed up over
/// the vertex and its neighbours first.
/// # Source
/// `cohensteiner_restricted_2003`, with neighbourhoods that follow the mesh.
pub(super) fn largest_curvatures(mesh: &DynamicMesh, is_left_out: impl Fn(u32) -> bool + Sync) -> Vec<f64> {
    let vertices = 0..mesh.positions.len() as u32;
    let own: Vec<Measure> =
        vertices.clone().into_par_iter().map(|v| measure_at(mesh, v, &is_left_out)).collect();
    vertices
        .into_par_iter()
        .map(|v| {
            let mut sum = own[v as usize];
            for w in mesh.neighbours(v) {
                sum.iter_mut().zip(own[w as usize]).for_each(|(x, y)| *x += y);
            }
            let [xx, xy, xz, yy, yz, zz, area] = sum;
            let largest = eigenvalues([xx, xy, xz, yy, yz, zz]).into_iter().map(f64::abs).fold(0.0, f64::max);
            if area > 0.0 { largest / area } else { 0.0 }
        })
        .collect()
}

/// The curvature of the curve through each vertex that one passes; 0 elsewhere, at corners too.
///
/// # Definition
/// That of the circle through the vertex and its neighbours on the curve.
pub(super) fn curvatures_of_curves(surface: &Marked) -> Vec<f64> {
    let mesh = &surface.mesh;
    let mut curvatures = vec![0.0; mesh.positions.len()];
    let mut beside: Vec<[u32; 2]> = vec![[NONE; 2]; mesh.positions.len()];
    for h in mesh.edges().filter(|&h| surface.curve[h as usize] != NONE) {
        for (v, w) in [(mesh.from(h), mesh.to(h)), (mesh.to(h), mesh.from(h))] {
            let known = &mut beside[v as usize];
            known[usize::from(known[0] != NONE)] = w;
        }
    }
    for (v, [u, w]) in beside.into_iter().enumerate() {
        if w != NONE && matches!(surface.hold[v], Hold::Curve(_)) {
            let [p, a, b] = [v, u as usize, w as usize].map(|v| mesh.positions[v]);
            let lengths = (a - p).length() * (b - p).length() * (b - a).length();
            let curvature = 2.0 * (a - p).cross(b - p).length() / lengths;
            curvatures[v] = if curvature.is_finite() { curvature } else { 0.0 };
        }
    }
    curvatures
}

fn measure_at(mesh: &DynamicMesh, v: u32, is_left_out: &impl Fn(u32) -> bool) -> Measure {
    let mut sum = [0.0; 7];
    let normal = |f: u32| {
        let [a, b, c] = mesh.corners(f).map(|v| mesh.positions[v as usize]);
        (b - a).cross(c - a)
    };
    for h in mesh.halfedges_from(v) {
        let n = normal(h / 3);
        sum[6] += n.length() / 6.0;
        let Some(t) = mesh.twin_of(h).filter(|_| !is_left_out(h)) else { continue };
        let m = normal(t / 3);
        let along = mesh.positions[mesh.to(h) as usize] - mesh.positions[v as usize];
        let Some(e) = along.try_normalize() else { continue };
        let angle = libm::atan2(m.cross(n).dot(e), n.dot(m));
        let weight = 0.5 * angle * along.length();
        for (x, y) in sum.iter_mut().zip([e.x * e.x, e.x * e.y, e.x * e.z, e.y * e.y, e.y * e.z, e.z * e.z]) {
            *x += weight * y;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Ends, cylinder, icosphere, torus};

    #[test]
    fn spheres_cylinders_and_tori() {
        let curvatures = |mesh: &pompeiu_core::TriMesh| {
            largest_curvatures(&DynamicMesh::new(mesh.positions(), mesh.faces()).expect("a manifold"), |_| {
                false
            })
        };
        for curvature in curvatures(&icosphere(2.0, 4).expect("a sphere")) {
            assert!((curvature - 0.5).abs() < 0.03, "{curvature}");
        }
        let tube = cylinder(0.5, 3.0, 64, 40, Ends::Open).expect("a cylinder");
        for (p, curvature) in tube.positions().iter().zip(curvatures(&tube)) {
            // At the boundary a part of the edges is missing.
            assert!((curvature - 2.0).abs() < 0.1 || p[2].abs() > 1.3, "{curvature} at {p:?}");
        }
        let ring = torus(2.0, 0.5, 96, 48).expect("a torus");
        for curvature in curvatures(&ring) {
            assert!((curvature - 2.0).abs() < 0.1, "{curvature}");
        }
    }
}
