//! Squared distances of points, edges and triangles, with derivatives, by one formula.
//!
//! # Definition
//! A pair has four points `x_i`; the vector between its closest points is `r = Σ w_i x_i`, with weights `w(β)` linear in up to two
//! parameters β. Of these, those inside their range are free: `r` is orthogonal to `r_a = Σ ∂_a w_i x_i` for each free parameter a.
//! Then `d² = r·r`, `∇d² = 2 w ⊗ r`, and `∇²d² = 2 w wᵀ ⊗ I − B C⁻¹ Bᵀ` with `C_ab = 2 r_a·r_b`, `B_a = 2 (∂_a w ⊗ r + w ⊗ r_a)`.
//!
//! # Accuracy
//! One Newton step `β −= C⁻¹ r_a·r` after the closest points are found makes r orthogonal: without it, gradients of close pairs lose
//! three digits.

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

impl Closest {
    /// The closest points of a pair.
    pub fn of(kind: Kind, x: &[DVec3; 4]) -> Self {
        match kind {
            Kind::PointTriangle => Self::point_triangle(x),
            Kind::EdgeEdge => Self::edge_edge(x),
            Kind::PointEdge => Self::point_edge(x, on_segment(x[0], x[1], x[2]), [1, 2]),
            Kind::PointPoint => {
                let weights = [1.0, -1.0, 0.0, 0.0];
                Self { weights, derivatives: [[0.0; 4]; 2], free: 0, vector: x[0] - x[1] }
            }
        }
    }

    /// Point 0 and the edge between two of the other points.
    fn point_edge(x: &[DVec3; 4], s: f64, [a, b]: [usize; 2]) -> Self {
        let mut weights = [1.0, 0.0, 0.0, 0.0];
        weights[a] = s - 1.0;
        weights[b] = -s;
        let mut by = [0.0; 4];
        (by[a], by[b]) = (1.0, -1.0);
        let free = usize::from(is_inside(s));
        Self { weights, derivatives: [by, [0.0; 4]], free, vector: sum(&weights, x) }.refined(x)
    }

    fn point_triangle(x: &[DVec3; 4]) -> Self {
        let [p, a, b, c] = *x;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        let (g00, g01, g11) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
        let (h0, h1) = (ab.dot(ap), ac.dot(ap));
        let determinant = g00 * g11 - g01 * g01;
        let (s, t) = ((g11 * h0 - g01 * h1) / determinant, (g00 * h1 - g01 * h0) / determinant);
        if s > 0.0 && t > 0.0 && s + t < 1.0 {
            let weights = [1.0, s + t - 1.0, -s, -t];
            let derivatives = [[0.0, 1.0, -1.0, 0.0], [0.0, 1.0, 0.0, -1.0]];
            return Self { weights, derivatives, free: 2, vector: sum(&weights, x) }.refined(x);
        }
        // The closest point is on the border: the nearest of three edges.
        let edges = [[1, 2], [2, 3], [3, 1]];
        let candidates = edges.map(|[i, j]| Self::point_edge(x, on_segment(p, x[i], x[j]), [i, j]));
        nearest(candidates)
    }

    fn edge_edge(x: &[DVec3; 4]) -> Self {
        let [a, b, c, d] = *x;
        let (u, v, w) = (b - a, d - c, a - c);
        let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
        let (uw, vw) = (u.dot(w), v.dot(w));
        // |u × v|² loses no digits where the edges are nearly parallel.
        let determinant = u.cross(v).length_squared();
        let (s, t) = ((uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant);
        if is_inside(s) && is_inside(t) {
            let weights = [1.0 - s, s, t - 1.0, -t];
            let derivatives = [[-1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]];
            return Self { weights, derivatives, free: 2, vector: sum(&weights, x) }.refined(x);
        }
        // One of the ends is closest.
        let end = |fixed: [f64; 2], of_first: bool| {
            let (point, other) = if of_first { ([0, 1], [2, 3]) } else { ([2, 3], [0, 1]) };
            let sign = if of_first { 1.0 } else { -1.0 };
            let p = x[point[0]] * fixed[0] + x[point[1]] * fixed[1];
            let t = on_segment(p, x[other[0]], x[other[1]]);
            let mut weights = [0.0; 4];
            (weights[point[0]], weights[point[1]]) = (sign * fixed[0], sign * fixed[1]);
            (weights[other[0]], weights[other[1]]) = (sign * (t - 1.0), -sign * t);
            let mut by = [0.0; 4];
            (by[other[0]], by[other[1]]) = (sign, -sign);
            let free = usize::from(is_inside(t));
            Self { weights, derivatives: [by, [0.0; 4]], free, vector: sum(&weights, x) }.refined(x)
        };
        nearest([
            end([1.0, 0.0], true),
            end([0.0, 1.0], true),
            end([1.0, 0.0], false),
            end([0.0, 1.0], false),
        ])
    }

    /// One Newton step for the free parameters.
    fn refined(mut self, x: &[DVec3; 4]) -> Self {
        let slopes = self.slopes(x);
        let g = [slopes[0].dot(self.vector), slopes[1].dot(self.vector)];
        let step = match self.free {
            0 => return self,
            1 => [g[0] / slopes[0].length_squared(), 0.0],
            _ => {
                let (a, b, c) =
                    (slopes[0].length_squared(), slopes[0].dot(slopes[1]), slopes[1].length_squared());
                let determinant = slopes[0].cross(slopes[1]).length_squared();
                [(c * g[0] - b * g[1]) / determinant, (a * g[1] - b * g[0]) / determinant]
            }
        };
        for a in 0..self.free {
            if step[a].is_finite() {
                for (w, by) in self.weights.iter_mut().zip(&self.derivatives[a]) {
                    *w -= step[a] * by;
                }
            }
        }
        self.vector = sum(&self.weights, x);
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
        let curvature = self.curvature(x);
        for (ba, inverse) in curvature.columns.iter().zip(curvature.inverse).take(self.free) {
            for (b, bb) in curvature.columns.iter().enumerate().take(self.free) {
                for i in 0..12 {
                    for j in 0..12 {
                        hessian[i][j] -= ba[i] * inverse[b] * bb[j];
                    }
                }
            }
        }
        hessian
    }

    /// The columns B and the inverse of C.
    fn curvature(&self, x: &[DVec3; 4]) -> Curvature {
        let slopes = self.slopes(x);
        let mut columns = [[0.0; 12]; 2];
        for a in 0..self.free {
            for i in 0..4 {
                let value = (self.vector * self.derivatives[a][i] + slopes[a] * self.weights[i]) * 2.0;
                columns[a][3 * i..3 * i + 3].copy_from_slice(&value.to_array());
            }
        }
        let (a, b, c) = (slopes[0].length_squared(), slopes[0].dot(slopes[1]), slopes[1].length_squared());
        let inverse = match self.free {
            0 => [[0.0; 2]; 2],
            1 => [[0.5 / a, 0.0], [0.0, 0.0]],
            _ => {
                let determinant = 2.0 * slopes[0].cross(slopes[1]).length_squared();
                [[c / determinant, -b / determinant], [-b / determinant, a / determinant]]
            }
        };
        Curvature { columns, inverse }
    }
}

struct Curvature {
    columns: [[f64; 12]; 2],
    inverse: [[f64; 2]; 2],
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
