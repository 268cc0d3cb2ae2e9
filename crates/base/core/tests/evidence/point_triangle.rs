//! The distance kernel against exact distances.

use pompeiu_core::geom::point_triangle::{closest_barycentric, distance_sq};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::exact::{Lattice, point_point_sq, point_triangle_sq};
use pompeiu_testkit::strategies::{coordinate, degenerate, point, soup};
use proptest::prelude::*;

/// Error of a distance, for coordinates up to one: 43 units of `2^-53`, as the rounding model of the engine counts them.
const DISTANCE: f64 = 43.0 * 0.5 * f64::EPSILON;

/// Points on, beside and away from a triangle, at many distances.
fn near(triangle: [[f64; 3]; 3]) -> impl Strategy<Value = [f64; 3]> {
    let weights = [0.0..1.0_f64, 0.0..1.0_f64, -0.25..1.0_f64];
    (weights, point(), 0..18_i32, coordinate()).prop_map(move |([s, t, u], away, digits, by)| {
        let total = s + t + u;
        let scale = by * 10.0_f64.powi(-digits);
        let on = |k: usize| (s * triangle[0][k] + t * triangle[1][k] + u * triangle[2][k]) / total;
        let p = [0, 1, 2].map(|k| on(k) + scale * away[k]);
        if p.iter().all(|x| x.abs() <= 1.0) { p } else { away }
    })
}

fn triangle_and_point() -> impl Strategy<Value = ([[f64; 3]; 3], [f64; 3])> {
    let mesh = prop_oneof![soup(1), degenerate(1)];
    mesh.prop_flat_map(|mesh: TriMesh| {
        let corners = mesh.corners(FaceId(0));
        near(corners).prop_map(move |p| (corners, p))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(4000)))]

    /// For needles, caps, segments and points, too: the kernel's result differs from the distance by no more than rounding in
    /// either direction.
    #[test]
    fn distances_are_exact_up_to_rounding((t, p) in triangle_and_point()) {
        let lattice = Lattice::of(&[&TriMesh::new(t.to_vec(), vec![[0, 1, 2]]).unwrap()]);
        let (x, triangle) = (lattice.point(p), lattice.triangle(t));
        let exact = lattice.length(&point_triangle_sq(&x, &triangle));
        let computed = distance_sq(p, t[0], t[1], t[2]).sqrt();
        prop_assert!((computed - exact).abs() <= DISTANCE, "{computed:e} for {exact:e}");
        // The point that the weights stand for is as near.
        let weights = closest_barycentric(p, t);
        prop_assert!(weights.iter().all(|w| *w >= 0.0), "{weights:?}");
        let closest = lattice.length(&point_point_sq(&x, &lattice.mean(&triangle, weights)));
        prop_assert!(closest <= exact + DISTANCE, "{closest:e} for {exact:e}");
    }
}
