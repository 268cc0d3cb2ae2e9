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

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> [DVec3; 3] {
        [DVec3::new(0.1, -0.2, 0.3), DVec3::new(1.3, 0.4, -0.1), DVec3::new(0.2, 1.1, 0.7)]
    }

    fn moved(at: usize, by: f64) -> Triangle {
        let mut corners = corners();
        corners[at / 3][at % 3] += by;
        Triangle::new(corners)
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let h = 1e-5;
        let here = Triangle::new(corners());
        let hessian = here.hessian(false);
        for column in 0..9 {
            let (ahead, behind) = (moved(column, h), moved(column, -h));
            let slope = (ahead.area - behind.area) / (2.0 * h);
            assert!((slope - here.gradient()[column / 3][column % 3]).abs() < 1e-9);
            for row in 0..9 {
                let of = |t: &Triangle| t.gradient()[row / 3][row % 3];
                let slope = (of(&ahead) - of(&behind)) / (2.0 * h);
                assert!((slope - hessian[row][column]).abs() < 1e-8, "{row} {column}");
            }
        }
    }

    #[test]
    fn the_clamped_hessian_is_the_positive_part() {
        let triangle = Triangle::new(corners());
        let (full, clamped) = (triangle.hessian(false), triangle.hessian(true));
        let times =
            |m: &[[f64; 9]; 9], x: [f64; 9]| m.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum::<f64>());
        for k in 0..9 {
            let x: [f64; 9] = std::array::from_fn(|i| ((i * 7 + k * 3) % 5) as f64 - 2.0);
            let dot = |y: [f64; 9]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
            // The positive part is never negative, and never below the whole; the difference, the negative part, is orthogonal to it.
            assert!(dot(times(&clamped, x)) >= -1e-14);
            assert!(dot(times(&clamped, x)) - dot(times(&full, x)) >= -1e-14);
            let negative: [f64; 9] = {
                let (a, b) = (times(&full, x), times(&clamped, x));
                std::array::from_fn(|i| a[i] - b[i])
            };
            assert!(times(&clamped, negative).iter().all(|y| y.abs() < 1e-14));
        }
    }

    #[test]
    fn along_directions_it_is_the_same_form() {
        let triangle = Triangle::new(corners());
        let directions = [DVec3::X, DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.6, 0.0, -0.8)];
        let (short, full) = (triangle.hessian_along(directions), triangle.hessian(false));
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            let mut sum = 0.0;
            for (k, l) in (0..9).map(|k| (k / 3, k % 3)) {
                sum += directions[i][k] * full[3 * i + k][3 * j + l] * directions[j][l];
            }
            assert!((sum - short[i][j]).abs() < 1e-15);
        }
    }

    #[test]
    fn a_triangle_without_area_has_no_derivatives() {
        let triangle = Triangle::new([DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]);
        assert_eq!(triangle.gradient(), [DVec3::ZERO; 3]);
        assert!(triangle.hessian(true).iter().flatten().all(|x| x.abs() <= 1.0));
    }
}
