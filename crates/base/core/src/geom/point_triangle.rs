//! Distance between a point and a triangle.
//!
//! One branch-free formula in three layouts: one point and one triangle, one point and eight triangles, four points and one
//! triangle. Compilers turn the loops of the last two into SIMD code. No operation is fused, so all three give the same bits on
//! every instruction set.

use glam::DVec3;

/// Triangles that are compared with a point at a time.
pub const LANES: usize = 8;

/// [`LANES`] triangles, corner by corner, coordinate by coordinate, lane last.
pub type TriangleBlock = [[[f64; LANES]; 3]; 3];

/// The corners of the triangle in a lane of a block.
#[inline]
pub fn lane_of(block: &TriangleBlock, lane: usize) -> [[f64; 3]; 3] {
    let mut corners = [[0.0; 3]; 3];
    for (corner, from) in corners.iter_mut().zip(block) {
        for k in 0..3 {
            corner[k] = from[k][lane];
        }
    }
    corners
}

/// Puts a triangle into a lane of a block.
#[inline]
pub fn set_lane(block: &mut TriangleBlock, lane: usize, corners: [[f64; 3]; 3]) {
    for (to, from) in block.iter_mut().zip(corners) {
        for k in 0..3 {
            to[k][lane] = from[k];
        }
    }
}

/// Squared distance from `p` to the nearest of up to four points of the triangle `abc`: the nearest point of each edge,
/// and the foot of the perpendicular where it falls inside.
///
/// # Accuracy
/// Each candidate is a convex combination of the corners, so the result never falls below the squared distance by more
/// than the rounding of one subtraction chain (see the rounding model of the engine), whatever the shape of the
/// triangle. Nor does it exceed it by more than a few units in the last place of the coordinates: with `u` the rounding
/// unit and d the distance, the foot is off by `u d / height` in the plane of the triangle, which lengthens the way to it
/// by half the square of that over d; where the height is so small that this matters, an edge is as near. A triangle
/// without area is the union of its edges, for which the formula holds too.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must be inlined into the lane loops to be vectorised")]
#[allow(
    clippy::needless_bitwise_bool,
    reason = "a branch here would keep the lane loops from being vectorised"
)]
pub fn distance_sq(p: [f64; 3], a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
    let (ap, bp) = (sub(p, a), sub(p, b));
    // Where the perpendiculars from p and from c meet ab, with a at 0 and b at 1.
    let inverse = 1.0 / dot(ab, ab);
    let (t, c) = (dot(ap, ab) * inverse, dot(ac, ab) * inverse);
    let on_ab = edge_distance_sq(ap, ab, t);
    let on_ac = edge_distance_sq(ap, ac, dot(ap, ac) / dot(ac, ac));
    let on_bc = edge_distance_sq(bp, bc, dot(bp, bc) / dot(bc, bc));
    let mut least = if on_ab < on_ac { on_ab } else { on_ac };
    least = if on_bc < least { on_bc } else { least };

    // The foot is given by its offset along ab and then along the height of c, not by the normal: a rounding error in a small
    // height then moves the foot by an equally small amount.
    let (height, beside) = (minus(ac, c, ab), minus(ap, t, ab));
    let w = dot(beside, height) / dot(height, height);
    let v = t - w * c;
    // The operand that v depends on comes last.
    let r = minus(minus(ap, w, ac), v, ab);
    let foot = dot(r, r);
    // Written so that a NaN from a triangle without area is "outside".
    let inside = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0) & (foot < least);
    if inside { foot } else { least }
}

/// Squared distance from the end of `ap` to the point `t ab`, with `t` clamped to the segment from the origin to `ab`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must be inlined into the lane loops to be vectorised")]
fn edge_distance_sq(ap: [f64; 3], ab: [f64; 3], t: f64) -> f64 {
    let t = if t > 0.0 { t } else { 0.0 };
    let t = if t < 1.0 { t } else { 1.0 };
    let r = minus(ap, t, ab);
    dot(r, r)
}

/// `a - s b`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn minus(a: [f64; 3], s: f64, b: [f64; 3]) -> [f64; 3] {
    [a[0] - s * b[0], a[1] - s * b[1], a[2] - s * b[2]]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// [`distance_sq`] from one point to each triangle of a block.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub fn block_distances_sq(p: [f64; 3], block: &TriangleBlock) -> [f64; LANES] {
    let mut out = [0.0; LANES];
    let [a, b, c] = block;
    for l in 0..LANES {
        out[l] = distance_sq(
            p,
            [a[0][l], a[1][l], a[2][l]],
            [b[0][l], b[1][l], b[2][l]],
            [c[0][l], c[1][l], c[2][l]],
        );
    }
    out
}

/// [`distance_sq`] from each of four points, coordinate by coordinate, to one triangle.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub fn four_points_distances_sq(points: &[[f64; 4]; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 4] {
    let mut out = [0.0; 4];
    for l in 0..4 {
        out[l] = distance_sq([points[0][l], points[1][l], points[2][l]], a, b, c);
    }
    out
}

/// Barycentric coordinates of a point of the triangle nearest to `p`: nonnegative, with sum 1 up to rounding.
///
/// The candidate points are those of [`distance_sq`].
pub fn closest_barycentric(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [p, a, b, c] = [p, a, b, c].map(DVec3::from_array);
    let along = |from: DVec3, to: DVec3| {
        let edge = to - from;
        let t = (p - from).dot(edge) / edge.dot(edge);
        if t > 0.0 { if t < 1.0 { t } else { 1.0 } } else { 0.0 }
    };
    let (t, s, r) = (along(a, b), along(a, c), along(b, c));
    let (ab, ac) = (b - a, c - a);
    let along_c = ac.dot(ab) / ab.dot(ab);
    let height = ac - along_c * ab;
    let along_p = (p - a).dot(ab) / ab.dot(ab);
    let w = (p - a - along_p * ab).dot(height) / height.dot(height);
    let v = along_p - w * along_c;
    let inside = v >= 0.0 && w >= 0.0 && v + w <= 1.0;
    // Adding zero turns a negative zero into a positive one.
    let foot = if inside { [1.0 - (v + w), v + 0.0, w + 0.0] } else { [1.0, 0.0, 0.0] };
    let distance_sq = |beta: &[f64; 3]| ((p - a) - beta[1] * (b - a) - beta[2] * (c - a)).length_squared();
    let mut best = foot;
    for beta in [[1.0 - t, t, 0.0], [1.0 - s, 0.0, s], [0.0, 1.0 - r, r]] {
        if distance_sq(&beta) < distance_sq(&best) {
            best = beta;
        }
    }
    best
}

/// Weights of the second and the third corner of a point of the triangle that is nearest to `p`, but for rounding: with one division, and with branches.
///
/// Neither is negative, and their sum is no greater than one, up to rounding. For callers to whom any point of the triangle will do; triangles
/// that are thin take the way of [`closest_barycentric`].
#[inline]
pub fn near_weights(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 2] {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [0.0, 0.0];
    }
    let (e, f, g) = (dot(ab, ab), dot(ab, ac), dot(ac, ac));
    // Products of two lengths tell nothing then. Written so that what is no number counts as thin.
    let is_wide = e * g - f * f > THIN * (e * g);
    if !is_wide {
        let [_, v, w] = closest_barycentric(p, [a, b, c]);
        return [v, w];
    }
    // The same products seen from the other corners.
    let (d3, d4) = (d1 - e, d2 - f);
    if d3 >= 0.0 && d4 <= d3 {
        return [1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return [fraction(d1, e), 0.0];
    }
    let (d5, d6) = (d1 - f, d2 - g);
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return [0.0, fraction(d2, g)];
    }
    let va = d3 * d6 - d5 * d4;
    let (to_c, to_b) = (d4 - d3, d5 - d6);
    if va <= 0.0 && to_c >= 0.0 && to_b >= 0.0 {
        let w = fraction(to_c, to_c + to_b);
        return [1.0 - w, w];
    }
    let inverse = 1.0 / (va + vb + vc);
    let v = bounded(vb * inverse);
    let w = bounded(vc * inverse);
    if v + w <= 1.0 { [v, w] } else { [v, 1.0 - v] }
}

/// The square of the sine of the angle at a corner below which a triangle is thin.
const THIN: f64 = 1e-6;

/// `x / y` between zero and one; zero where it is no number.
#[inline]
fn fraction(x: f64, y: f64) -> f64 {
    bounded(x / y)
}

#[inline]
fn bounded(x: f64) -> f64 {
    let x = if x > 0.0 { x } else { 0.0 };
    if x < 1.0 { x } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const T: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

    #[test]
    fn every_region_of_a_triangle() {
        let cases = [
            ([0.5, 0.5, 3.0], 9.0),
            ([1.0, -2.0, 0.0], 4.0),
            ([-3.0, 1.0, 0.0], 9.0),
            ([2.0, 2.0, 1.0], 3.0),
            ([-1.0, -1.0, 1.0], 3.0),
            ([4.0, -1.0, 0.0], 5.0),
            ([-1.0, 4.0, 0.0], 5.0),
        ];
        for (p, expected) in cases {
            assert!((distance_sq(p, T[0], T[1], T[2]) - expected).abs() < 1e-14, "{p:?}");
        }
    }

    #[test]
    fn triangles_without_area_are_segments_and_points() {
        let p = [1.0, 1.0, 0.0];
        assert_eq!(distance_sq(p, [0.0; 3], [0.0; 3], [0.0; 3]), 2.0);
        assert_eq!(distance_sq(p, [0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]), 1.0);
        assert_eq!(distance_sq(p, [5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [3.0, 0.0, 0.0]), 5.0);
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0, (-3..4_i32).prop_map(|k| f64::from(k) * 0.25)]
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        [coordinate(), coordinate(), coordinate()]
    }

    proptest! {
        #[test]
        fn no_point_of_the_triangle_is_nearer(
            p in point(), t in [point(), point(), point()], s in 0.0..1.0, r in 0.0..1.0_f64
        ) {
            let d = distance_sq(p, t[0], t[1], t[2]).sqrt();
            let (v, w) = (s * (1.0 - r), s * r);
            let q = [0, 1, 2].map(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k]));
            prop_assert!(d <= dot(sub(p, q), sub(p, q)).sqrt() + 1e-12);
        }

        #[test]
        fn all_shapes_agree_bit_for_bit(p in point(), t in [point(), point(), point()]) {
            let d = distance_sq(p, t[0], t[1], t[2]);
            let block: TriangleBlock = t.map(|corner| corner.map(|x| [x; LANES]));
            prop_assert_eq!(block_distances_sq(p, &block), [d; LANES]);
            prop_assert_eq!(four_points_distances_sq(&p.map(|x| [x; 4]), t), [d; 4]);
        }

        #[test]
        fn near_weights_give_the_nearest_point(p in point(), t in [point(), point(), point()], thin in prop_oneof![Just(1.0), Just(1e-3), Just(1e-7), Just(0.0)]) {
            // Of any shape, also without area.
            let t = [t[0], t[1], [0, 1, 2].map(|k| t[0][k] + 0.4 * (t[1][k] - t[0][k]) + thin * (t[2][k] - t[0][k]))];
            let [v, w] = near_weights(p, t);
            prop_assert!(v >= 0.0 && w >= 0.0 && v + w <= 1.0 + 1e-15, "{v} {w}");
            let q = [0, 1, 2].map(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k]));
            let d = distance_sq(p, t[0], t[1], t[2]).sqrt();
            prop_assert!((dot(sub(p, q), sub(p, q)).sqrt() - d).abs() < 1e-7);
        }

        #[test]
        fn barycentric_coordinates_give_the_distance(p in point(), t in [point(), point(), point()]) {
            let beta = closest_barycentric(p, t);
            prop_assert!(beta.iter().all(|&x| x >= 0.0) && (beta.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            let q = [0, 1, 2].map(|k| (0..3).map(|j| beta[j] * t[j][k]).sum());
            let d = distance_sq(p, t[0], t[1], t[2]).sqrt();
            prop_assert!((dot(sub(p, q), sub(p, q)).sqrt() - d).abs() < 1e-14);
        }
    }
}
