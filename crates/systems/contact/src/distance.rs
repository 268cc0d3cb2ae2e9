//! Squared distances of points, edges and triangles, with derivatives, by one formula.
//!
//! # Definition
//! A pair has four points `x_i`; the vector between its closest points is `r = Σ w_i x_i`, with weights `w(β)` linear in up to two
//! parameters β. Of these, those inside their range are free: `r` is orthogonal to `r_a = Σ ∂_a w_i x_i` for each free parameter a.
//! Then `d² = r·r`, `∇d² = 2 w ⊗ r`, and `∇²d² = 2 w wᵀ ⊗ I − B C⁻¹ Bᵀ` with `C_ab = 2 r_a·r_b`, `B_a = 2 (∂_a w ⊗ r + w ⊗ r_a)`.
//!
//! # Accuracy
//! Parameters follow from cross products, which lose digits as the sine of the angle between edges, not as its square. The vector between the
//! closest points is summed with twice the digits of doubles, and then made orthogonal to what is free: squared distances and gradients
//! keep their digits however close a pair is. [`distance_sq`] leaves that out, and is as accurate as coordinates are rounded.
//!
//! # Source
//! `ogita_accurate_2005` for the sum.

use crate::precise::{two_sum, weighted_sum};
use glam::DVec3;

/// What the first and the second part of a pair are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Point 0 and the triangle of points 1, 2, 3.
    PointTriangle,
    /// The edges of points 0, 1 and of points 2, 3.
    EdgeEdge,
    /// Point 0 and the edge of points 1, 2; point 3 is not used.
    PointEdge,
    /// Points 0 and 1; points 2, 3 are not used.
    PointPoint,
}

impl Kind {
    /// Number of points that are used.
    pub const fn count(self) -> usize {
        match self {
            Self::PointTriangle | Self::EdgeEdge => 4,
            Self::PointEdge => 3,
            Self::PointPoint => 2,
        }
    }
}

/// The closest points of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The weights w of the four points.
    pub weights: [f64; 4],
    /// What rounding leaves out of the weights: with it they sum up to nothing.
    left_out: [f64; 4],
    /// Derivatives of the weights by free parameters, `free` of them.
    pub derivatives: [[f64; 4]; 2],
    /// Number of free parameters: 0, 1 or 2.
    pub free: usize,
    /// The vector between the closest points.
    pub vector: DVec3,
}

/// The sum of points with weights.
fn sum(weights: &[f64; 4], x: &[DVec3; 4]) -> DVec3 {
    x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2] + x[3] * weights[3]
}

/// Whether a parameter is strictly between 0 and 1.
fn is_inside(s: f64) -> bool {
    s > 0.0 && s < 1.0
}

/// The parameter in [0, 1] of the point of a segment that is closest to a point.
fn on_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let e = b - a;
    let square = e.length_squared();
    if square > 0.0 { ((p - a).dot(e) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// The squared distance of a pair, in a fraction of the time of [`Closest::of`], with an error of the rounding of coordinates.
pub fn distance_sq(kind: Kind, x: &[DVec3; 4]) -> f64 {
    match kind {
        Kind::PointTriangle => point_triangle_sq(x),
        Kind::EdgeEdge => edge_edge_sq(x),
        Kind::PointEdge => point_segment_sq(x[0], x[1], x[2]),
        Kind::PointPoint => x[0].distance_squared(x[1]),
    }
}

fn point_segment_sq(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    (p - a - (b - a) * on_segment(p, a, b)).length_squared()
}

/// The parameters of the foot of a point on the plane of a triangle; NaN where it is a segment or a point.
fn foot(ab: DVec3, ac: DVec3, ap: DVec3) -> (f64, f64, DVec3) {
    let n = ab.cross(ac);
    let square = n.length_squared();
    (ap.cross(ac).dot(n) / square, ab.cross(ap).dot(n) / square, n)
}

fn point_triangle_sq(&[p, a, b, c]: &[DVec3; 4]) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (s, t, _) = foot(ab, ac, ap);
    if s > 0.0 && t > 0.0 && s + t < 1.0 {
        return (ap - ab * s - ac * t).length_squared();
    }
    // Only sides that the foot lies beyond can be nearest; all where the triangle is degenerate.
    let mut least = f64::INFINITY;
    for (is_before, i, j) in [(t > 0.0, a, b), (s > 0.0, a, c), (s + t < 1.0, b, c)] {
        if !is_before {
            let square = point_segment_sq(p, i, j);
            least = if square < least { square } else { least };
        }
    }
    least
}

/// The parameters of the common perpendicular of two lines; NaN where they are parallel.
fn perpendicular(u: DVec3, v: DVec3, w: DVec3) -> (f64, f64, DVec3) {
    let n = u.cross(v);
    let square = n.length_squared();
    (v.cross(w).dot(n) / square, u.cross(w).dot(n) / square, n)
}

fn edge_edge_sq(&[a, b, c, d]: &[DVec3; 4]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (s, t, _) = perpendicular(u, v, w);
    if is_inside(s) && is_inside(t) {
        return (w + u * s - v * t).length_squared();
    }
    // On the second edge, the point closest to that of the first; then the other way round if it is an end. Whichever point of the first
    // one begins where they are nearly parallel, the distance is the same but for rounding.
    let s = if s.is_finite() { s.clamp(0.0, 1.0) } else { 0.0 };
    let t = on_segment(a + u * s, c, d);
    let s = if is_inside(t) { s } else { on_segment(c + v * t, a, b) };
    (w + u * s - v * t).length_squared()
}

impl Closest {
    /// The closest points of a pair.
    pub fn of(kind: Kind, x: &[DVec3; 4]) -> Self {
        match kind {
            Kind::PointTriangle => Self::point_triangle(x),
            Kind::EdgeEdge => Self::edge_edge(x),
            Kind::PointEdge => Self::point_edge(x, [1, 2]).refined(x, DVec3::ZERO),
            Kind::PointPoint => {
                let weights = [1.0, -1.0, 0.0, 0.0];
                let vector = x[0] - x[1];
                Self { weights, left_out: [0.0; 4], derivatives: [[0.0; 4]; 2], free: 0, vector }
            }
        }
    }

    /// Point 0 and the edge between two of the other points.
    fn point_edge(x: &[DVec3; 4], [a, b]: [usize; 2]) -> Self {
        let s = on_segment(x[0], x[a], x[b]);
        let (mut weights, mut left_out, mut by) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4]);
        (weights[a], left_out[a]) = two_sum(s, -1.0);
        weights[b] = -s;
        (by[a], by[b]) = (1.0, -1.0);
        let free = usize::from(is_inside(s));
        let vector = sum(&weights, x);
        Self { weights, left_out, derivatives: [by, [0.0; 4]], free, vector }
    }

    fn point_triangle(x: &[DVec3; 4]) -> Self {
        let [p, a, b, c] = *x;
        let (s, t, n) = foot(b - a, c - a, p - a);
        if s > 0.0 && t > 0.0 && s + t < 1.0 {
            let (share, lost) = two_sum(s, t);
            let (first, left) = two_sum(share, -1.0);
            let derivatives = [[0.0, 1.0, -1.0, 0.0], [0.0, 1.0, 0.0, -1.0]];
            let (weights, left_out) = ([1.0, first, -s, -t], [0.0, left + lost, 0.0, 0.0]);
            return Self { weights, left_out, derivatives, free: 2, vector: DVec3::ZERO }.refined(x, n);
        }
        // The closest point is on the border: the nearest of three edges.
        nearest([[1, 2], [2, 3], [3, 1]].map(|edge| Self::point_edge(x, edge))).refined(x, DVec3::ZERO)
    }

    fn edge_edge(x: &[DVec3; 4]) -> Self {
        let [a, b, c, d] = *x;
        let (s, t, n) = perpendicular(b - a, d - c, a - c);
        if is_inside(s) && is_inside(t) {
            let ((first, of_first), (third, of_third)) = (two_sum(1.0, -s), two_sum(t, -1.0));
            let derivatives = [[-1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]];
            let (weights, left_out) = ([first, s, third, -t], [of_first, 0.0, of_third, 0.0]);
            return Self { weights, left_out, derivatives, free: 2, vector: DVec3::ZERO }.refined(x, n);
        }
        // One of the ends is closest.
        let end = |fixed: [f64; 2], of_first: bool| {
            let (point, other) = if of_first { ([0, 1], [2, 3]) } else { ([2, 3], [0, 1]) };
            let sign = if of_first { 1.0 } else { -1.0 };
            let p = x[point[0]] * fixed[0] + x[point[1]] * fixed[1];
            let t = on_segment(p, x[other[0]], x[other[1]]);
            let (before, lost) = two_sum(t, -1.0);
            let (mut weights, mut left_out, mut by) = ([0.0; 4], [0.0; 4], [0.0; 4]);
            (weights[point[0]], weights[point[1]]) = (sign * fixed[0], sign * fixed[1]);
            (weights[other[0]], weights[other[1]]) = (sign * before, -sign * t);
            left_out[other[0]] = sign * lost;
            (by[other[0]], by[other[1]]) = (sign, -sign);
            let free = usize::from(is_inside(t));
            let vector = sum(&weights, x);
            Self { weights, left_out, derivatives: [by, [0.0; 4]], free, vector }
        };
        let ends = [([1.0, 0.0], true), ([0.0, 1.0], true), ([1.0, 0.0], false), ([0.0, 1.0], false)];
        nearest(ends.map(|(fixed, of_first)| end(fixed, of_first))).refined(x, DVec3::ZERO)
    }

    /// The vector with all its digits: summed with twice as many, then orthogonal to the slopes of free parameters, whose normal is given
    /// where there are two.
    fn refined(mut self, x: &[DVec3; 4], normal: DVec3) -> Self {
        let vector = weighted_sum(&self.weights, &self.left_out, x);
        self.vector = match self.free {
            0 => vector,
            1 => {
                let slope = sum(&self.derivatives[0], x);
                vector - slope * (slope.dot(vector) / slope.length_squared())
            }
            _ => normal * (normal.dot(vector) / normal.length_squared()),
        };
        self
    }

    /// The derivatives of the vector by the free parameters.
    fn slopes(&self, x: &[DVec3; 4]) -> [DVec3; 2] {
        [sum(&self.derivatives[0], x), sum(&self.derivatives[1], x)]
    }

    /// The squared distance.
    pub fn distance_sq(&self) -> f64 {
        self.vector.length_squared()
    }

    /// The gradient of the squared distance, point by point.
    pub fn gradient(&self) -> [DVec3; 4] {
        self.weights.map(|w| self.vector * (2.0 * w))
    }

    /// The second derivatives of the squared distance, three rows for each point.
    pub fn hessian(&self, x: &[DVec3; 4]) -> [[f64; 12]; 12] {
        let mut hessian = [[0.0; 12]; 12];
        for i in 0..4 {
            for j in 0..4 {
                for k in 0..3 {
                    hessian[3 * i + k][3 * j + k] = 2.0 * self.weights[i] * self.weights[j];
                }
            }
        }
        let (slopes, inverse) = self.slopes_and_inverse(x);
        let column = |a: usize| -> [f64; 12] {
            std::array::from_fn(|i| {
                let (point, axis) = (i / 3, i % 3);
                2.0 * (self.vector[axis] * self.derivatives[a][point] + slopes[a][axis] * self.weights[point])
            })
        };
        let columns = [column(0), column(1)];
        for (ba, inverse) in columns.iter().zip(inverse).take(self.free) {
            for (b, bb) in columns.iter().enumerate().take(self.free) {
                for i in 0..12 {
                    for j in 0..12 {
                        hessian[i][j] -= ba[i] * inverse[b] * bb[j];
                    }
                }
            }
        }
        hessian
    }

    /// The slopes of free parameters, and the inverse of `C`.
    pub(crate) fn slopes_and_inverse(&self, x: &[DVec3; 4]) -> ([DVec3; 2], [[f64; 2]; 2]) {
        let slopes = self.slopes(x);
        let (a, b, c) = (slopes[0].length_squared(), slopes[0].dot(slopes[1]), slopes[1].length_squared());
        let inverse = match self.free {
            0 => [[0.0; 2]; 2],
            1 => [[0.5 / a, 0.0], [0.0, 0.0]],
            _ => {
                let determinant = 2.0 * slopes[0].cross(slopes[1]).length_squared();
                [[c / determinant, -b / determinant], [-b / determinant, a / determinant]]
            }
        };
        (slopes, inverse)
    }
}

/// The candidate with the least distance; the first of equal ones.
fn nearest<const N: usize>(candidates: [Closest; N]) -> Closest {
    let mut best = candidates[0];
    for candidate in &candidates[1..] {
        if candidate.distance_sq() < best.distance_sq() {
            best = *candidate;
        }
    }
    best
}
