//! Loops of flips: towards regular valences, and towards Delaunay triangles.

use super::connectivity::{DynamicMesh, NONE, next, previous};
use super::marked::Marked;
use super::triangle::{area_vector, is_no_thinner, shape};
use glam::DVec3;

/// Cosine between the normals of both faces at an edge, before and after a flip, below which it is left alone.
const LEAST_COSINE: f64 = 0.5;

/// Rounds of flips towards regular valences.
const MOST_ROUNDS: usize = 4;

/// The corners of both faces at an edge: its start and end, and the corners opposite it.
pub(super) fn hinge(mesh: &DynamicMesh, h: u32, t: u32) -> [u32; 4] {
    [mesh.from(h), mesh.to(h), mesh.from(previous(h)), mesh.from(previous(t))]
}

/// Whether flipping keeps the surface smooth: its faces are nearly in one plane before and after.
fn stays_smooth([u, v, a, b]: [DVec3; 4]) -> bool {
    let [old_a, old_b, new_u, new_v] = [[u, v, a], [v, u, b], [a, u, b], [b, v, a]].map(area_vector);
    let near = |n: DVec3, m: DVec3| n.dot(m) > LEAST_COSINE * n.length() * m.length();
    let all = old_a + old_b;
    let thinnest = |s: [DVec3; 3], t: [DVec3; 3]| if shape(s) < shape(t) { s } else { t };
    // A face that is thin or without area may go, but not come.
    is_no_thinner(thinnest([a, u, b], [b, v, a]), thinnest([u, v, a], [v, u, b]))
        && (near(old_a, old_b) || old_a == DVec3::ZERO || old_b == DVec3::ZERO)
        && near(new_u, new_v)
        && near(new_u, all)
        && near(new_v, all)
}

/// Flips edges while this brings valences nearer to 6, or 4 at the boundary: their squared differences become fewer with each flip,
/// so it ends.
pub(super) fn flip_to_regular(surface: &mut Marked) -> usize {
    let mesh = &surface.mesh;
    let mut excess: Vec<isize> = (0..mesh.positions.len() as u32)
        .map(|v| mesh.neighbours(v).count().cast_signed() - mesh.regular_valence(v).cast_signed())
        .collect();
    let mut total = 0;
    for _ in 0..MOST_ROUNDS {
        let mut flipped = 0;
        for h in 0..surface.mesh.halfedge_slots() {
            let mesh = &surface.mesh;
            let Some(t) = mesh.exists(h).then(|| mesh.twin_of(h)).flatten().filter(|&t| h < t) else {
                continue;
            };
            let corners = hinge(mesh, h, t);
            let [u, v, a, b] = corners.map(|x| excess[x as usize]);
            // (u-1)^2 + (v-1)^2 + (a+1)^2 + (b+1)^2 less than before.
            if a + b - u - v + 2 >= 0 || !stays_smooth(corners.map(|x| mesh.positions[x as usize])) {
                continue;
            }
            if surface.flip(h) {
                for (x, change) in corners.into_iter().zip([-1, -1, 1, 1]) {
                    excess[x as usize] += change;
                }
                flipped += 1;
            }
        }
        total += flipped;
        if flipped == 0 {
            break;
        }
    }
    total
}

/// The sum of the cotangents of a triangle, with the same bits for any order of its corners; infinite without area.
fn cotangents(mut corners: [DVec3; 3]) -> f64 {
    corners.sort_by(|p, q| p.to_array().partial_cmp(&q.to_array()).unwrap_or(std::cmp::Ordering::Equal));
    let [a, b, c] = corners;
    let sum = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    let area = area_vector(corners).length();
    if area > 0.0 { sum / (2.0 * area) } else { f64::INFINITY }
}

/// Whether flipping an edge makes the sum of all cotangents less, and keeps the surface smooth.
pub(super) fn lowers_cotangents(corners: [DVec3; 4]) -> bool {
    let [u, v, a, b] = corners;
    let before = cotangents([u, v, a]) + cotangents([v, u, b]);
    let after = cotangents([a, u, b]) + cotangents([b, v, a]);
    after < before && stays_smooth(corners)
}

/// Flips edges while this makes the sum of all cotangents less: in a plane until the triangulation is Delaunay.
///
/// # Why it ends
/// The sum of what [`cotangents`] returns falls with each flip, as real numbers: rounding a sum of two never turns an order
/// around. It is determined by the triangulation, of which there are finitely many.
/// # Source
/// In a plane an edge is not Delaunay exactly where flipping it lowers this sum: `musin_properties_1997`.
pub(super) fn flip_to_delaunay(surface: &mut Marked) -> usize {
    let mut open: Vec<u32> = surface.mesh.edges().collect();
    let mut waits = vec![false; surface.mesh.origin.len()];
    for &h in &open {
        waits[h as usize] = true;
    }
    open.reverse();
    let mut flipped = 0;
    while let Some(h) = open.pop() {
        waits[h as usize] = false;
        let mesh = &surface.mesh;
        let Some(t) = mesh.twin_of(h) else { continue };
        let corners = hinge(mesh, h, t).map(|x| mesh.positions[x as usize]);
        if lowers_cotangents(corners) && surface.flip(h) {
            flipped += 1;
            for side in [next(h), previous(h), next(t), previous(t)] {
                let other = surface.mesh.twin[side as usize];
                let edge = if other < side { other } else { side };
                if other != NONE && !waits[edge as usize] {
                    waits[edge as usize] = true;
                    open.push(edge);
                }
            }
        }
    }
    flipped
}

#[cfg(test)]
mod tests {
    use super::super::features::{Curves, Features};
    use super::*;
    use pompeiu_core::TriMesh;
    use pompeiu_core::geom::{Aabb, Frame};
    use pompeiu_core::mesh::displace_at_random;
    use pompeiu_core::mesh::shapes::{Diagonal, grid};
    use pompeiu_core::spatial::bvh::Bvh;

    /// A triangulation of a square with vertices moved about in its plane.
    fn jittered() -> Marked {
        let square =
            displace_at_random(&grid([20.0, 20.0], [20, 20], Diagonal::Rising).expect("a grid"), 0.3, 5)
                .expect("a mesh");
        let flat = square.positions().iter().map(|p| [p[0], p[1], 0.0]).collect();
        let flat = TriMesh::new(flat, square.faces().to_vec()).expect("a mesh");
        let mesh = DynamicMesh::new(flat.positions(), flat.faces()).expect("a manifold");
        let curves = Curves::find(&mesh, &Features::default());
        let near =
            vec![Bvh::build(&flat, &Frame::of(&Aabb::of_faces(&flat))).any_slot(); mesh.positions.len()];
        Marked { curve: curves.of_halfedge, hold: curves.hold, length: vec![1.0; near.len()], near, mesh }
    }

    /// The sine of the sum of the angles opposite an edge: below 0 exactly where the edge is not Delaunay.
    fn delaunay_sine(mesh: &DynamicMesh, h: u32, t: u32) -> f64 {
        let [u, v, a, b] = hinge(mesh, h, t).map(|x| mesh.positions[x as usize]);
        let angle = |apex: DVec3| (u - apex).angle_between(v - apex);
        (angle(a) + angle(b)).sin()
    }

    #[test]
    fn every_edge_in_a_plane_becomes_delaunay() {
        let mut surface = jittered();
        let worst = |surface: &Marked| {
            let mesh = &surface.mesh;
            let inner = mesh.edges().filter_map(|h| Some((h, mesh.twin_of(h)?)));
            inner
                .map(|(h, t)| delaunay_sine(mesh, h, t))
                .fold(f64::INFINITY, |x, y| if y < x { y } else { x })
        };
        assert!(worst(&surface) < -0.1, "something is to be done");
        assert!(flip_to_delaunay(&mut surface) > 20);
        assert!(worst(&surface) >= -1e-12, "{:e}", worst(&surface));
        surface.assert_valid();
    }
}
