//! Quadric error: sums of squared distances from planes.

use glam::{DMat3, DVec3};

/// `x ↦ xᵀ A x + 2 b·x + c`, a sum of weighted squared distances from planes.
///
/// # Source
/// `garland_surface_1997`, section 4.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Quadric {
    a: DMat3Symmetric,
    b: DVec3,
    c: f64,
}

/// The upper triangle of a symmetric matrix: xx, xy, xz, yy, yz, zz.
type DMat3Symmetric = [f64; 6];

impl Quadric {
    /// `weight` times the squared distance from the plane through `p` with this unit normal.
    pub(crate) fn of_plane(normal: DVec3, p: DVec3, weight: f64) -> Self {
        let d = -normal.dot(p);
        let DVec3 { x, y, z } = normal;
        Self {
            a: [x * x, x * y, x * z, y * y, y * z, z * z].map(|v| weight * v),
            b: weight * d * normal,
            c: weight * d * d,
        }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let mut a = self.a;
        a.iter_mut().zip(other.a).for_each(|(x, y)| *x += y);
        Self { a, b: self.b + other.b, c: self.c + other.c }
    }

    /// The sum of all weights.
    pub(crate) fn weight(&self) -> f64 {
        let [xx, _, _, yy, _, zz] = self.a;
        xx + yy + zz
    }

    fn matrix(&self) -> DMat3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
    }

    /// The value at a point; not below zero.
    pub(crate) fn at(&self, p: DVec3) -> f64 {
        let value = p.dot(self.matrix() * p) + 2.0 * self.b.dot(p) + self.c;
        if value > 0.0 { value } else { 0.0 }
    }

    /// The point of least value that is nearest to `near` in the directions in which the value hardly changes.
    ///
    /// Eigenvalues below [`FLAT`] times the largest count as zero, so that a flat or straight place does not move the point
    /// along itself.
    pub(crate) fn optimum(&self, near: DVec3) -> DVec3 {
        // The residual at `near`, solved in the directions that matter.
        let residual = times(self.a, near) + self.b;
        near - solved(self.a, residual).unwrap_or_else(|| solved_by_axes(self.matrix(), residual))
    }
}

/// A symmetric matrix times a vector.
fn times([xx, xy, xz, yy, yz, zz]: DMat3Symmetric, v: DVec3) -> DVec3 {
    DVec3::new(xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z)
}

/// The solution of least length of a system whose eigenvalues below [`FLAT`] times the largest count as zero, from its axes.
fn solved_by_axes(matrix: DMat3, residual: DVec3) -> DVec3 {
    let (values, vectors) = eigen(matrix);
    let largest = values.iter().copied().fold(0.0, |m: f64, x| if x > m { x } else { m });
    let mut solution = DVec3::ZERO;
    for (value, axis) in values.into_iter().zip(vectors) {
        if value > FLAT * largest {
            solution += axis * (axis.dot(residual) / value);
        }
    }
    solution
}

/// The second eigenvalue is taken to count where it is at least this many times [`FLAT`] of the largest: it is far from the third one then.
const SURELY: f64 = 4.0;

/// The same as [`solved_by_axes`], where the number of eigenvalues that count is seen from the coefficients of the characteristic
/// polynomial; none where it is not.
///
/// With eigenvalues p ≥ q ≥ r, the projection onto the axis of p is (A − q)(A − r) over (p − q)(p − r), by the theorem of Cayley and
/// Hamilton (adj A + p (A − q − r)) over the same, and so on for the others. On the plane of the first two axes the inverse of A is
/// (p + q − A) over p q.
fn solved(a: DMat3Symmetric, residual: DVec3) -> Option<DVec3> {
    let [xx, xy, xz, yy, yz, zz] = a;
    let adjugate = [
        yy * zz - yz * yz,
        xz * yz - xy * zz,
        xy * yz - xz * yy,
        xx * zz - xz * xz,
        xy * xz - xx * yz,
        xx * yy - xy * xy,
    ];
    let trace = xx + yy + zz;
    let minors = adjugate[0] + adjugate[3] + adjugate[5];
    let determinant = xx * adjugate[0] + xy * adjugate[1] + xz * adjugate[2];
    // p q r over the sum of p q, p r and q r is at most r, and the trace at least p.
    if determinant > FLAT * trace * minors {
        return Some(times(adjugate, residual) / determinant);
    }
    // q + r is at most about that sum over the trace.
    let is_flat = minors <= 0.9 * FLAT * trace * trace;
    let mut root = if is_flat { trace } else { 0.0 };
    for _ in 0..MOST_STEPS {
        let value = ((root - trace) * root + minors) * root - determinant;
        let step = value / ((3.0 * root - 2.0 * trace) * root + minors);
        root -= step;
        if step.abs() <= CLOSE * trace {
            break;
        }
    }
    let others = trace - root;
    let product = minors - root * others;
    let apart = root * (root - others) + product;
    let along = (times(adjugate, residual) + root * (times(a, residual) - others * residual)) / apart;
    if is_flat {
        return (apart > 0.0).then(|| along / root);
    }
    let is_clear = root <= 0.5 * FLAT * others && product >= SURELY * FLAT * others * others;
    let across = residual - along;
    is_clear.then(|| (others * across - times(a, across)) / product)
}

/// Squares of entries beside the diagonal count as zero below this part of the squared trace.
const NEGLIGIBLE: f64 = 1e-34;

/// Ratio of eigenvalues below which a direction counts as flat.
const FLAT: f64 = 1e-3;

/// Eigenvalues of the symmetric matrix with this upper triangle: xx, xy, xz, yy, yz, zz.
pub(crate) fn eigenvalues(upper: [f64; 6]) -> [f64; 3] {
    eigen(Quadric { a: upper, ..Quadric::default() }.matrix()).0
}

/// Largest eigenvalues are computed alone where the product of their distances from both others is at least this part of the squared
/// trace: the eigenvector is accurate to about the precision of a double divided by it.
const SEPARATE: f64 = 1e-2;

/// Roots are close enough to an eigenvalue after a step that is smaller than this part of the trace: the next one would be its square.
const CLOSE: f64 = 1e-9;

/// Steps of Newton's method for an eigenvalue. They come from above and converge quadratically beside others that are [`SEPARATE`].
const MOST_STEPS: usize = 12;

/// Eigenvalues and eigenvectors of a symmetric matrix that is not negative.
///
/// In most quadrics one eigenvalue is much larger than the others: it is computed first, and leaves a matrix of two rows.
fn eigen(matrix: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let Some((largest, axis)) = largest_alone(matrix) else { return eigen_by_rotations(matrix) };
    let (u, w) = axis.any_orthonormal_pair();
    let [of_u, of_w] = [u, w].map(|x| matrix * x);
    let (uu, uw, ww) = (u.dot(of_u), u.dot(of_w), w.dot(of_w));
    if uw == 0.0 {
        return ([largest, uu, ww], [axis, u, w]);
    }
    let [t, c, s] = rotation(uu, uw, ww);
    ([largest, uu - t * uw, ww + t * uw], [axis, c * u - s * w, s * u + c * w])
}

/// The largest eigenvalue of a matrix that is not negative and its eigenvector, if it is far enough from the others.
fn largest_alone(matrix: DMat3) -> Option<(f64, DVec3)> {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let trace = x.x + y.y + z.z;
    let minors = x.x * y.y - x.y * x.y + x.x * z.z - x.z * x.z + y.y * z.z - y.z * y.z;
    let determinant = matrix.determinant();
    // All roots are at most the trace; from there on the polynomial is convex down to the largest.
    let mut root = trace;
    for _ in 0..MOST_STEPS {
        let value = ((root - trace) * root + minors) * root - determinant;
        let step = value / ((3.0 * root - 2.0 * trace) * root + minors);
        root -= step;
        if step.abs() <= 2.0 * f64::EPSILON * trace {
            break;
        }
    }
    // Each row of the adjugate of what is left is along the eigenvector, the longest is the most accurate.
    let [x, y, z] = [x - root * DVec3::X, y - root * DVec3::Y, z - root * DVec3::Z];
    let along = [y.cross(z), z.cross(x), x.cross(y)];
    let [a, b, c] = along.map(DVec3::length_squared);
    let longest = if a >= b && a >= c { 0 } else { 1 + usize::from(c > b) };
    let length_sq = [a, b, c][longest];
    let least = SEPARATE * trace * trace;
    (length_sq >= least * least && least > 0.0).then(|| (root, along[longest] / length_sq.sqrt()))
}

/// Tangent, cosine and sine of the rotation that makes a symmetric matrix of two rows diagonal; `pq` is not zero.
fn rotation(pp: f64, pq: f64, qq: f64) -> [f64; 3] {
    let theta = (qq - pp) / (2.0 * pq);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    [t, c, t * c]
}

/// Eigenvalues and eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn eigen_by_rotations(matrix: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut a = matrix.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    // Convergence is quadratic: six sweeps reach double precision, most often fewer.
    for _ in 0..6 {
        let beside = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
        let trace = a[0][0] + a[1][1] + a[2][2];
        if beside <= NEGLIGIBLE * trace * trace {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let [_, c, s] = rotation(a[p][p], a[p][q], a[q][q]);
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
            }
            for row in &mut v {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
        }
    }
    let column = |i: usize| DVec3::new(v[0][i], v[1][i], v[2][i]);
    ([a[0][0], a[1][1], a[2][2]], [column(0), column(1), column(2)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    #[test]
    fn the_value_is_the_sum_of_squared_distances() {
        let planes = [(DVec3::X, DVec3::new(1.0, 5.0, 2.0), 2.0), (DVec3::Y, DVec3::new(4.0, 3.0, 0.0), 0.5)];
        let q = planes.iter().fold(Quadric::default(), |q, (n, p, w)| q.plus(&Quadric::of_plane(*n, *p, *w)));
        let p = DVec3::new(2.0, -1.0, 7.0);
        assert!((q.at(p) - (2.0 * 1.0 + 0.5 * 16.0)).abs() < 1e-12);
    }

    #[test]
    fn the_optimum_of_three_planes_is_where_they_meet() {
        let normals = [DVec3::new(1.0, 0.2, 0.0), DVec3::new(0.0, 1.0, -0.3), DVec3::new(0.4, 0.0, 1.0)];
        let corner = DVec3::new(0.3, -0.7, 0.2);
        let q = normals
            .iter()
            .fold(Quadric::default(), |q, n| q.plus(&Quadric::of_plane(n.normalize(), corner, 1.0)));
        assert!((q.optimum(DVec3::ZERO) - corner).length() < 1e-12);
    }

    #[test]
    fn on_a_flat_or_straight_place_the_optimum_does_not_slide() {
        let near = DVec3::new(3.0, 4.0, 5.0);
        let flat = Quadric::of_plane(DVec3::Z, DVec3::ZERO, 1.0);
        assert!((flat.optimum(near) - DVec3::new(3.0, 4.0, 0.0)).length() < 1e-12);
        let straight = flat.plus(&Quadric::of_plane(DVec3::Y, DVec3::ZERO, 4.0));
        assert!((straight.optimum(near) - DVec3::new(3.0, 0.0, 0.0)).length() < 1e-12);
    }

    #[test]
    fn eigenvalues_computed_one_by_one_are_those_of_rotations() {
        let mut random = Random::new(7);
        let mut next = || f64::from(random.below(1 << 20)) / f64::from(1 << 20) - 0.5;
        let mut alone = 0;
        for case in 0..2000 {
            // Normals that are ever closer to each other, of weights at any scale.
            let spread = 4.0 * 0.7_f64.powi(case % 40);
            let scale = 10_f64.powi(case % 61 - 30);
            let q = (0..4).fold(Quadric::default(), |q, _| {
                let normal = DVec3::Z + spread * DVec3::new(next(), next(), next());
                q.plus(&Quadric::of_plane(normal.normalize(), DVec3::ZERO, scale * (0.6 + next())))
            });
            let matrix = q.matrix();
            alone += usize::from(largest_alone(matrix).is_some());
            let (values, vectors) = eigen(matrix);
            let mut sorted = values;
            let mut expected = eigen_by_rotations(matrix).0;
            sorted.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (found, expected) in sorted.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-13 * q.weight(), "{case}: {sorted:?} {expected:?}");
            }
            for (value, vector) in values.into_iter().zip(vectors) {
                assert!((matrix * vector - value * vector).length() < 1e-12 * q.weight(), "{case}");
                assert!((vector.length() - 1.0).abs() < 1e-14, "{case}");
            }
        }
        assert!((1000..2000).contains(&alone), "{alone}");
    }

    /// Where eigenvectors are not computed the solution is the same.
    #[test]
    fn systems_are_solved_as_by_their_axes() {
        let mut random = Random::new(11);
        let mut next = || f64::from(random.below(1 << 20)) / f64::from(1 << 20) - 0.5;
        let mut by_count = [0; 4];
        for case in 0..4000 {
            let spread = 4.0 * 0.8_f64.powi(case % 40);
            let across = 0.7_f64.powi(case / 40 % 20);
            let q = (0..6).fold(Quadric::default(), |q, _| {
                let normal = DVec3::Z + spread * DVec3::new(next(), across * next(), next() * 0.1);
                q.plus(&Quadric::of_plane(normal.normalize(), DVec3::ZERO, 0.6 + next()))
            });
            let residual = DVec3::new(next(), next(), next());
            let values = eigen(q.matrix()).0;
            let count = values.iter().filter(|v| **v > FLAT * q.weight()).count();
            let Some(found) = solved(q.a, residual) else { continue };
            by_count[count] += 1;
            let expected = solved_by_axes(q.matrix(), residual);
            let error = (found - expected).length();
            assert!(error < 1e-9 * expected.length(), "{case}: {found} {expected} {values:?}");
        }
        assert!(by_count[0] == 0 && by_count[1..].iter().all(|n| *n > 300), "{by_count:?}");
        assert_eq!(solved([0.0; 6], DVec3::X), None);
    }
}
