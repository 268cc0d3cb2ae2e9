//! A face of A before it is looked at, and what the distances of its corners alone say of it: a function below the distance, without a look at B.
//!
//! # What is proven
//! For any point c the function `d(x)^2 - |x - c|^2` is concave, d being the distance from B: it is the least of `|x - y|^2 - |x - c|^2` over the
//! points y of B, and these are linear in x. So at the point of a triangle with corners `p_i` and weights `w_i`
//!
//! `d(x)^2 >= sum w_i (d(p_i)^2 - |p_i - c|^2) + |x - c|^2 >= sum w_i l_i^2` with `l_i^2 = d(p_i)^2 - |p_i - c|^2`,
//!
//! as long as no `l_i^2` is negative; and a root is concave, so `d(x) >= sum w_i l_i`: the interpolation of `l_i` lies below the distance.
//! With the centroid for c it loses about the square of the edge by six times the distance.
//!
//! Distances of corners are lowered by what rounding may add to them before, so what is left is the rounding of `(d - r) (d + r)` and its
//! root, relative to a result that is no longer than d (see [`rounding`](crate::rounding)).

use pompeiu_core::spatial::Slot;

/// A face of A, and what is known about it before it is looked at. Lengths are in the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub(super) corners: [[f64; 3]; 3],
    /// Its area, rounded.
    pub(super) area: f64,
    /// Distances of the corners from B, rounded.
    pub(super) distances: [f64; 3],
    /// The faces of B nearest to them.
    pub(super) near: [Slot; 3],
}

/// Values at the corners of a function below the distance on a face; none where it is too near for its size. No distance of a corner is
/// less than the given one by more than `margin`.
pub(super) fn below(corners: [[f64; 3]; 3], distances: [f64; 3], margin: f64) -> Option<[f64; 3]> {
    let [a, b, c] = corners;
    let centre: [f64; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) * (1.0 / 3.0));
    let mut below = [0.0; 3];
    for i in 0..3 {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|k| corners[i][k] - centre[k]);
        let from_centre = (x * x + y * y + z * z).sqrt() * MORE;
        let distance = distances[i] - margin;
        // What is no number is not greater.
        let is_far = distance > from_centre;
        if !is_far {
            return None;
        }
        below[i] = ((distance - from_centre) * (distance + from_centre)).sqrt() - margin;
    }
    Some(below)
}

/// Outweighs the rounding of a length.
const MORE: f64 = 1.0 + 8.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_testkit::effort::cases;
    use pompeiu_testkit::plain::point_triangles;
    use proptest::prelude::*;

    fn points(count: impl Into<prop::collection::SizeRange>) -> impl Strategy<Value = Vec<[f64; 3]>> {
        prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], count)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(400)))]

        /// On the face the distance from all triangles is no less, at any distance from them.
        #[test]
        fn no_triangle_is_nearer(
            faces in prop::collection::vec(points(3), 1..40),
            face in points(3),
            size in 0.01..2.0_f64,
            height in 0.0..4.0_f64,
        ) {
            let triangles: Vec<[[f64; 3]; 3]> = faces.iter().map(|f| [f[0], f[1], f[2]]).collect();
            let corners = [0, 1, 2].map(|i| {
                let [x, y, z] = face[i];
                [size * x, size * y, size * z + height]
            });
            let distances = corners.map(|p| point_triangles(p, &triangles));
            let Some(below) = below(corners, distances, 1e-14) else { return Ok(()) };
            for [v, w] in [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.25, 0.25], [1.0 / 3.0, 1.0 / 3.0], [0.1, 0.8]] {
                let x = [0, 1, 2].map(|k| {
                    corners[0][k] + v * (corners[1][k] - corners[0][k]) + w * (corners[2][k] - corners[0][k])
                });
                let here = below[0] + v * (below[1] - below[0]) + w * (below[2] - below[0]);
                let exact = point_triangles(x, &triangles);
                prop_assert!(here <= exact + 1e-14, "{here} {exact}");
            }
        }
    }

    /// Over the nearest corner of B, where the gap is that of a ball: no more than promised is lost.
    #[test]
    fn little_is_lost_far_away() {
        let edge = 0.1;
        let height = 0.5 * edge * 3.0_f64.sqrt();
        let corners = [[0.0, 0.0, 1.0], [edge, 0.0, 1.0], [0.5 * edge, height, 1.0]];
        let below = below(corners, [1.0; 3], 0.0).expect("it is far away");
        for value in below {
            assert!(1.0 - value < 1.01 * edge * edge / 6.0 && value < 1.0, "{value}");
        }
        assert_eq!(super::below(corners, [0.05; 3], 0.0), None);
        assert_eq!(super::below(corners, [1.0, f64::NAN, 1.0], 0.0), None);
    }
}
