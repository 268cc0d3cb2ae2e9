//! Faces of B as seen from a face T of A: linear functions on T, given by their values at the corners of T.
//!
//! # What is proven
//! Let F be a face of B with corners `a, a + e1, a + e2` and computed unit normal n. For each corner t of T the weights `b1, b2` of the
//! foot of the perpendicular on F's plane are computed once and then taken as exact: extended linearly over T they say of every
//! point x of T which point `y(x) = a + b1(x) e1 + b2(x) e2` of F is meant. With `r = x - y`, linear too, and `h = n . (t - a)` at the
//! corners, `|r(x)| <= |h(x)| + defect`, where the defect is the greatest `|r - h n|` at a corner. So where the weights say that y
//! lies in F, F is no farther from x than `|h(x)| + defect`, whatever rounding made of the normal and the weights. Weights are used
//! only while `|b1| |e1| + |b2| |e2| <= 2 M` at the corners ([`Scale::size`] is M).
//!
//! In units of `u M` (u = 2^-53): differences of points are off by `2 sqrt(3)`, products with weights by 4, so r by less than 22; a
//! linear function with values up to F at the corners is evaluated with an error of at most `10 u F` (two differences, two products,
//! two sums), below 35 for h; the length of n adds 14. The error in the weights, scaled to lengths, moves y out of F by less than 52.
//! Together below 125, and below 140 with the defect's own rounding: less than [`Scale::margin`], which is twice
//! [`EVALUATION`](crate::rounding::EVALUATION).
//!
//! **From below**, F lies behind the plane with unit normal g through `y + s g` with `s = max_j g . (t_j - y)`, so `g . (x - y) - s` is
//! below its distance from x. The values at the corners of T are off by 65 (see [`rounding`](crate::rounding)), their evaluation by 35:
//! together 100.
//!
//! **An estimate from below** is `sqrt(h^2 + s^2)` with s the way from the foot to the farthest side beyond which it lies. Of a face whose
//! edges enclose an angle with a sine above [`LEAST_SINE`] it is off by less than [`ESTIMATE`] relative and by the margin above; other
//! faces have no estimate.
//!
//! Both hold at the exact corners of a polygon. The stored ones are off by [`Outline::displacement`]
//! in both weights; distances and the functions here change by no more than the way ([`Scale::displacement`]).

use super::polygon::{MOST_CORNERS, Outline, Row};
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::spatial::Slot;

/// Faces with a thinner corner have no estimate of their distance.
const LEAST_SINE: f64 = 1e-4;
/// Relative error of an estimate, at most: that of a normal is a few u over the sine.
pub(super) const ESTIMATE: f64 = 1e-9;

/// A linear function on T: its value at the first corner, and how much greater it is at the second and at the third.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Linear([f64; 3]);

impl Linear {
    pub(super) fn through([a, b, c]: [f64; 3]) -> Self {
        Self([a, b - a, c - a])
    }

    #[inline]
    pub(super) fn at(&self, [v, w]: [f64; 2]) -> f64 {
        let [a, b, c] = self.0;
        a + v * b + w * c
    }

    pub(super) fn negative(&self) -> Self {
        Self(self.0.map(|x| -x))
    }

    #[inline]
    pub(super) fn row(&self, outline: &Outline) -> Row {
        let [a, b, c] = self.0;
        let mut row = [0.0; MOST_CORNERS];
        for j in 0..MOST_CORNERS {
            row[j] = a + outline.v[j] * b + outline.w[j] * c;
        }
        row
    }
}

/// A face of A, and how far rounding goes on it.
pub(super) struct Scale {
    pub(super) corners: [DVec3; 3],
    edges: [DVec3; 2],
    /// Greatest coordinate of both meshes.
    pub(super) size: f64,
    /// How far computed bounds at the corners of a polygon may be off, before cuts.
    pub(super) margin: f64,
    /// Lengths of both edges.
    reach: f64,
}

impl Scale {
    pub(super) fn new(corners: [[f64; 3]; 3], rounding: Rounding) -> Self {
        let corners = corners.map(DVec3::from_array);
        let edges = [corners[1] - corners[0], corners[2] - corners[0]];
        let reach = (edges[0].length() + edges[1].length()) * (1.0 + 8.0 * f64::EPSILON);
        let size = rounding.size();
        Self { corners, edges, size, margin: 2.0 * rounding.bound(0), reach }
    }

    /// The point with these weights of the second and third corner.
    #[inline]
    pub(super) fn point(&self, [v, w]: [f64; 2]) -> DVec3 {
        self.corners[0] + v * self.edges[0] + w * self.edges[1]
    }

    /// The corners of a polygon, coordinate by coordinate.
    pub(super) fn points(&self, outline: &Outline) -> [Row; 3] {
        let mut points = [[0.0; MOST_CORNERS]; 3];
        for (k, row) in points.iter_mut().enumerate() {
            let (p, q, r) = (self.corners[0][k], self.edges[0][k], self.edges[1][k]);
            for j in 0..MOST_CORNERS {
                row[j] = p + outline.v[j] * q + outline.w[j] * r;
            }
        }
        points
    }

    /// The way between points whose weights differ by so much.
    #[inline]
    pub(super) fn way(&self, [v, w]: [f64; 2]) -> DVec3 {
        v * self.edges[0] + w * self.edges[1]
    }

    /// The square of the length of the longest edge.
    pub(super) fn longest_edge_sq(&self) -> f64 {
        let [u, v] = self.edges;
        [u, v, v - u]
            .into_iter()
            .map(DVec3::length_squared)
            .fold(0.0, |most, x| if x > most { x } else { most })
    }

    /// The normal of the face, or zero.
    pub(super) fn normal(&self) -> DVec3 {
        let normal = self.edges[0].cross(self.edges[1]);
        let length = normal.length();
        if length > f64::MIN_POSITIVE.sqrt() { normal / length } else { DVec3::ZERO }
    }

    /// How far stored corners of a polygon may be from the exact ones.
    pub(super) fn displacement(&self, outline: &Outline) -> f64 {
        outline.displacement() * self.reach
    }

    /// The linear function `g . (x - y)`.
    pub(super) fn along(&self, g: DVec3, y: DVec3) -> Linear {
        Linear::through(self.corners.map(|t| g.dot(t - y)))
    }
}

/// A face of B.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) slot: Slot,
    pub(super) corners: [DVec3; 3],
    /// Of length one; zero for a face without area.
    pub(super) normal: DVec3,
    /// Signed height over the plane of the face.
    pub(super) height: Linear,
    /// How far outside of each side the foot of the perpendicular lies; not positive inside.
    pub(super) sides: [Linear; 3],
    /// See above; infinite where the sides must not be relied on.
    defect: f64,
    /// How far the face reaches above its plane, and below, by rounding.
    pub(super) bulge: [f64; 2],
}

impl Candidate {
    pub(super) fn new(slot: Slot, corners: [[f64; 3]; 3], scale: &Scale) -> Self {
        let corners = corners.map(DVec3::from_array);
        let a = corners[0];
        let (e1, e2) = (corners[1] - a, corners[2] - a);
        let normal = e1.cross(e2);
        let square = normal.length_squared();
        if square < f64::MIN_POSITIVE.sqrt() {
            return Self {
                slot,
                corners,
                normal: DVec3::ZERO,
                height: Linear::default(),
                sides: [Linear::default(); 3],
                defect: f64::INFINITY,
                bulge: [0.0; 2],
            };
        }
        let inverse = 1.0 / square;
        let (d1, d2) = (e2.cross(normal) * inverse, normal.cross(e1) * inverse);
        let normal = normal * inverse.sqrt();
        let (l1, l2) = (e1.length(), e2.length());
        // The gradients of the weights have the lengths of one over the heights.
        let heights = [d1, d2, d1 + d2].map(|d| 1.0 / d.length());
        let mut height = [0.0; 3];
        let mut sides = [[0.0; 3]; 3];
        let (mut defect, mut reach) = (0.0, 0.0);
        for (j, t) in scale.corners.iter().enumerate() {
            let p = *t - a;
            let (b1, b2) = (d1.dot(p), d2.dot(p));
            height[j] = normal.dot(p);
            let off = (p - b1 * e1 - b2 * e2 - height[j] * normal).length();
            let far = b1.abs() * l1 + b2.abs() * l2;
            defect = if off > defect { off } else { defect };
            reach = if far > reach { far } else { reach };
            for (side, value) in sides.iter_mut().zip([-b1, -b2, b1 + b2 - 1.0]) {
                side[j] = value;
            }
        }
        for (side, height) in sides.iter_mut().zip(heights) {
            *side = side.map(|x| x * height);
        }
        let blunt = square > LEAST_SINE * LEAST_SINE * e1.length_squared() * e2.length_squared();
        let usable = blunt && reach <= 2.0 * scale.size && defect <= scale.margin;
        let (n1, n2) = (normal.dot(e1), normal.dot(e2));
        let most = |x: f64, y: f64| if x > y { x } else { y };
        Self {
            slot,
            corners,
            normal,
            height: Linear::through(height),
            sides: sides.map(Linear::through),
            defect: if usable { defect } else { f64::INFINITY },
            bulge: [most(most(n1, n2), 0.0), most(most(-n1, -n2), 0.0)],
        }
    }

    /// Whether the sides may be relied on.
    pub(super) fn is_usable(&self) -> bool {
        self.defect < f64::INFINITY
    }

    /// A bound from above on the distance of a point whose foot is inside and which has this height; before [`Scale::margin`].
    pub(super) fn above(&self, height: f64) -> f64 {
        height.abs() + self.defect
    }

    /// An estimate of the distance from below, and whether the foot is inside.
    #[inline]
    pub(super) fn estimate(&self, at: [f64; 2]) -> (f64, bool) {
        let [a, b, c] = [self.sides[0].at(at), self.sides[1].at(at), self.sides[2].at(at)];
        let beside = if a > b { a } else { b };
        let beside = if beside > c { beside } else { c };
        let height = self.height.at(at);
        if beside <= 0.0 { (height.abs(), true) } else { ((height * height + beside * beside).sqrt(), false) }
    }

    /// How far the face reaches along g beyond y.
    pub(super) fn reach_along(&self, g: DVec3, y: DVec3) -> f64 {
        let [a, b, c] = self.corners.map(|t| g.dot(t - y));
        let m = if a > b { a } else { b };
        if m > c { m } else { c }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Target;
    use pompeiu_core::TriMesh;
    use pompeiu_testkit::plain::point_triangle;
    use proptest::prelude::*;

    fn triangle() -> impl Strategy<Value = [[f64; 3]; 3]> {
        let coordinate =
            || prop_oneof![-1.0..1.0_f64, (-2..3_i32).prop_map(|k| 0.25 * f64::from(k)), Just(1e-9)];
        prop::array::uniform3(prop::array::uniform3(coordinate()))
    }

    fn slot() -> Slot {
        Target::new(&TriMesh::new(vec![[0.0; 3]], vec![[0, 0, 0]]).unwrap()).bvh().any_slot()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Where the foot is said to be inside, the distance is what is said; estimates and planes are below it.
        #[test]
        fn functions_bound_the_distance(t in triangle(), f in triangle(), at in [0.0..0.5_f64, 0.0..0.5], g in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0]) {
            let scale = Scale::new(t, Rounding::new(1.0));
            let face = Candidate::new(slot(), f, &scale);
            let exact = point_triangle(scale.point(at).to_array(), f);
            let margin = scale.margin;
            if face.is_usable() {
                let (estimate, inside) = face.estimate(at);
                prop_assert!(estimate * (1.0 - ESTIMATE) - margin <= exact, "{estimate} {exact}");
                if inside {
                    let above = face.above(face.height.at(at));
                    prop_assert!(exact <= above + margin && above <= exact + margin, "{exact} {above}");
                }
            }
            let g = DVec3::from_array(g).normalize_or(DVec3::X);
            let y = face.corners[0];
            let plane = scale.along(g, y).at(at) - face.reach_along(g, y);
            prop_assert!(plane <= exact + margin);
            let height = face.height.at(at);
            if face.normal != DVec3::ZERO {
                prop_assert!(height - face.bulge[0] <= exact + margin && -height - face.bulge[1] <= exact + margin);
            }
        }
    }
}
