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
        let matrix = self.matrix();
        let (values, vectors) = eigen(matrix);
        let largest = values.iter().copied().fold(0.0, |m: f64, x| if x > m { x } else { m });
        // The residual at `near`, solved in the directions that matter.
        let residual = matrix * near + self.b;
        let mut p = near;
        for (value, axis) in values.into_iter().zip(vectors) {
            if value > FLAT * largest {
                p -= axis * (axis.dot(residual) / value);
            }
        }
        p
    }
}

/// Squares of entries beside the diagonal count as zero below this part of the squared trace.
const NEGLIGIBLE: f64 = 1e-34;

/// Ratio of eigenvalues below which a direction counts as flat.
const FLAT: f64 = 1e-3;

/// Eigenvalues of the symmetric matrix with this upper triangle: xx, xy, xz, yy, yz, zz.
pub(crate) fn eigenvalues(upper: [f64; 6]) -> [f64; 3] {
    eigen(Quadric { a: upper, ..Quadric::default() }.matrix()).0
}

/// Eigenvalues and eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn eigen(matrix: DMat3) -> ([f64; 3], [DVec3; 3]) {
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
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
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
}
