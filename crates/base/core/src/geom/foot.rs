//! Fast upper bounds on the distances from many points to one triangle.

use glam::DVec3;
use multiversion::multiversion;

/// A triangle prepared for projecting points onto its plane without divisions.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    origin: [f64; 3],
    /// Edges from the origin to the other corners.
    edges: [[f64; 3]; 2],
    /// Barycentric coordinate `i + 1` of the foot of `x` is `dual[i] . (x - origin)`.
    dual: [[f64; 3]; 2],
}

impl Foot {
    /// Prepares a triangle of any shape.
    pub fn new(corners: [[f64; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(DVec3::from_array);
        let (e1, e2) = (b - a, c - a);
        let n = e1.cross(e2);
        let inverse = 1.0 / n.dot(n);
        let dual = [e2.cross(n) * inverse, n.cross(e1) * inverse];
        Self { origin: a.to_array(), edges: [e1, e2].map(|e| e.to_array()), dual: dual.map(|g| g.to_array()) }
    }

    /// Upper bounds on the squared distances of four points from the triangle: the distances from the feet of their
    /// perpendiculars, moved into the triangle where they fall outside. Any weights that are not negative and sum to one
    /// at most name a point of the triangle, so the rounding is that of
    /// [`distance_sq`](super::point_triangle::distance_sq) whatever its shape.
    pub fn bounds_sq(&self, points: &[[f64; 4]; 3]) -> [f64; 4] {
        bounds_sq(self, points)
    }

    /// Barycentric coordinates of the feet of four points, coordinate by coordinate; NaN for a triangle without area.
    #[inline]
    pub fn four_weights(&self, points: &[[f64; 4]; 3]) -> [[f64; 4]; 3] {
        let Self { origin, dual: [g, h], .. } = self;
        let mut weights = [[0.0; 4]; 3];
        for l in 0..4 {
            let r = [points[0][l] - origin[0], points[1][l] - origin[1], points[2][l] - origin[2]];
            weights[1][l] = g[0] * r[0] + g[1] * r[1] + g[2] * r[2];
            weights[2][l] = h[0] * r[0] + h[1] * r[1] + h[2] * r[2];
            weights[0][l] = 1.0 - weights[1][l] - weights[2][l];
        }
        weights
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn bounds_sq(foot: &Foot, points: &[[f64; 4]; 3]) -> [f64; 4] {
    let Foot { origin, edges: [e, f], dual: [g, h] } = foot;
    let mut out = [0.0; 4];
    for l in 0..4 {
        let r = [points[0][l] - origin[0], points[1][l] - origin[1], points[2][l] - origin[2]];
        let v = g[0] * r[0] + g[1] * r[1] + g[2] * r[2];
        let w = h[0] * r[0] + h[1] * r[1] + h[2] * r[2];
        // A NaN from a triangle without area must end at the first corner. One choice at a time keeps the loop vectorisable.
        let v = if v > 0.0 { v } else { 0.0 };
        let w = if w > 0.0 { w } else { 0.0 };
        let excess = v + w - 1.0;
        let half = 0.5 * if excess > 0.0 { excess } else { 0.0 };
        let v = v - half;
        let w = w - half;
        let v = if v > 0.0 { v } else { 0.0 };
        let w = if w > 0.0 { w } else { 0.0 };
        let v = if v < 1.0 { v } else { 1.0 };
        // This also holds where both are so large that rounding half of the excess exceeds the size of the triangle.
        let rest = 1.0 - v;
        let w = if w < rest { w } else { rest };
        let d = [r[0] - v * e[0] - w * f[0], r[1] - v * e[1] - w * f[1], r[2] - v * e[2] - w * f[2]];
        out[l] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point_triangle::distance_sq;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bounds_the_distance_and_is_exact_over_the_triangle(
            corners in [[-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0]],
            x in [-2.0..2.0_f64, -2.0..2.0, -2.0..2.0],
            over in (0.0..0.5_f64, 0.0..0.5_f64, -1.0..1.0_f64),
        ) {
            let foot = Foot::new(corners);
            let [a, b, c] = corners.map(DVec3::from_array);
            let normal = (b - a).cross(c - a);
            prop_assume!(normal.length() > 1e-3);
            let y = (a + over.0 * (b - a) + over.1 * (c - a) + over.2 * normal.normalize()).to_array();
            let lanes = [0, 1, 2].map(|k| [x[k], y[k], x[k], y[k]]);
            let [bound, exact, ..] = foot.bounds_sq(&lanes);
            prop_assert!(bound >= distance_sq(x, corners[0], corners[1], corners[2]) * (1.0 - 1e-12) - 1e-30);
            prop_assert!((exact.sqrt() - over.2.abs()).abs() < 1e-9);
        }
    }

    /// Degenerate triangles: the bound may be loose, but must be a bound.
    #[test]
    fn triangles_without_area_have_bounds() {
        let x = [[0.5, 2.0, -1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0; 4]];
        let needle = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-22, 0.0]];
        for corners in [[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[1.0, 0.0, 0.0]; 3], needle] {
            let bounds = Foot::new(corners).bounds_sq(&x);
            for l in 0..4 {
                let p = [x[0][l], x[1][l], x[2][l]];
                assert!(bounds[l] >= distance_sq(p, corners[0], corners[1], corners[2]), "{corners:?} {p:?}");
            }
        }
    }
}
