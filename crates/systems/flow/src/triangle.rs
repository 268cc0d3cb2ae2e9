//! Area of one triangle, with its first and second derivatives.

use glam::DVec3;

/// A triangle, ready for derivatives of its area.
///
/// # Definition
/// With `e_i` the edge opposite corner i, directed along the boundary, and n the unit normal: the gradient of the area at corner i is
/// `½ n × e_i`, and the second derivative by corners i and j is `(e_i · e_j)/(4A) n nᵀ + ½ s_ij [n]×`, where `s_ij` is 1 if j
/// follows i's successor, −1 if j is i's successor, and 0 if i = j.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Edges opposite the corners.
    pub(crate) edges: [DVec3; 3],
    /// Unit normal; zero if there is no area.
    pub(crate) normal: DVec3,
    pub(crate) area: f64,
    /// `1/(4A)`; zero if there is no area.
    quarter: f64,
}

impl Triangle {
    #[inline]
    pub(crate) fn new([a, b, c]: [DVec3; 3]) -> Self {
        let edges = [c - b, a - c, b - a];
        let twice = edges[2].cross(-edges[1]);
        let length = twice.length();
        let (normal, quarter) = if length > f64::MIN_POSITIVE && (0.5 / length).is_finite() {
            (twice / length, 0.5 / length)
        } else {
            (DVec3::ZERO, 0.0)
        };
        Self { edges, normal, area: 0.5 * length, quarter }
    }

    /// The gradient of the area at each corner.
    #[inline]
    pub(crate) fn gradient(&self) -> [DVec3; 3] {
        self.edges.map(|edge| 0.5 * self.normal.cross(edge))
    }

    /// The stiffness of linear functions: `½ (cot)` weights off the diagonal, negative, rows that add up to zero.
    #[inline]
    pub(crate) fn stiffness(&self) -> [[f64; 3]; 3] {
        let e = &self.edges;
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| e[i].dot(e[j]) * self.quarter))
    }

    /// `d_iᵀ H_ij d_j` for one direction at each corner.
    #[inline]
    pub(crate) fn hessian_along(&self, directions: [DVec3; 3]) -> [[f64; 3]; 3] {
        let stiffness = self.stiffness();
        let n = self.normal;
        let along = directions.map(|d| d.dot(n));
        let across = directions.map(|d| n.cross(d));
        [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                stiffness[i][j] * along[i] * along[j] + 0.5 * sign(i, j) * directions[i].dot(across[j])
            })
        })
    }

    /// The second derivatives by all nine coordinates; with `clamp` those of its in-plane part that are negative left out.
    ///
    /// The in-plane part S has the eigenvalues ±√3/2, twice each, and 0, so that `S² = ¾ P` with P the projection onto its range, and
    /// its positive part is `½ (S + (√3/2) P)`. The part along the normal is never negative.
    pub(crate) fn hessian(&self, clamp: bool) -> [[f64; 9]; 9] {
        let stiffness = self.stiffness();
        let n = self.normal;
        let cross = [[0.0, -n.z, n.y], [n.z, 0.0, -n.x], [-n.y, n.x, 0.0]];
        let n = n.to_array();
        let (skew, range) = if clamp { (0.25, 3_f64.sqrt() / 4.0) } else { (0.5, 0.0) };
        let mut hessian = [[0.0; 9]; 9];
        for (row, values) in hessian.iter_mut().enumerate() {
            for (column, value) in values.iter_mut().enumerate() {
                let ((i, k), (j, l)) = ((row / 3, row % 3), (column / 3, column % 3));
                let unit = |a: usize, b: usize| f64::from(u8::from(a == b));
                let tangent = unit(k, l) - n[k] * n[l];
                *value = stiffness[i][j] * n[k] * n[l]
                    + skew * sign(i, j) * cross[k][l]
                    + range * (unit(i, j) - 1.0 / 3.0) * tangent;
            }
        }
        hessian
    }
}

/// The derivative of the edge opposite corner i by corner j.
#[inline]
fn sign(i: usize, j: usize) -> f64 {
    match (j + 3 - i) % 3 {
        1 => -1.0,
        2 => 1.0,
        _ => 0.0,
    }
}
