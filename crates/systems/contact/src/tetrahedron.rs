//! Elastic energies of tetrahedra, with gradients and positive semi-definite second derivatives.

use crate::dense::eigen;
use crate::elastic::Block;
use glam::{DMat3, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;

/// A compressible neo-Hookean tetrahedron: `V (μ/2 (|F|² − 3) − μ ln J + λ/2 (ln J)²)`, infinite for `J ≤ 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tetrahedron {
    pub(crate) vertices: [u32; 4],
    /// The inverse of the edge vectors at rest.
    pub(crate) inverse: DMat3,
    pub(crate) volume: f64,
    /// μ and λ.
    pub(crate) lame: (f64, f64),
}

impl Tetrahedron {
    fn deformation(&self, x: &[DVec3; 4]) -> DMat3 {
        DMat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0]) * self.inverse
    }

    pub(crate) fn energy(&self, x: &[DVec3; 4]) -> f64 {
        // By H = F − I: of a stiff body at rest in its first position, |F|² − 3 and ln J would be differences of large numbers.
        let h = self.deformation(x) - DMat3::IDENTITY;
        let trace = h.x_axis.x + h.y_axis.y + h.z_axis.z;
        let minors = h.x_axis.x * h.y_axis.y - h.x_axis.y * h.y_axis.x + h.x_axis.x * h.z_axis.z
            - h.x_axis.z * h.z_axis.x
            + h.y_axis.y * h.z_axis.z
            - h.y_axis.z * h.z_axis.y;
        let growth = trace + minors + h.determinant();
        if growth.is_nan() || growth <= -1.0 {
            return f64::INFINITY;
        }
        let ((mu, lambda), log) = (self.lame, libm::log1p(growth));
        let square = h.x_axis.length_squared() + h.y_axis.length_squared() + h.z_axis.length_squared();
        self.volume * (mu * (trace - log + 0.5 * square) + 0.5 * lambda * log * log)
    }

    /// Rows of the derivative of F by the vertices: `F = Σ x_i g_iᵀ`.
    fn gradients(&self) -> [DVec3; 4] {
        let t = self.inverse.transpose();
        [-(t.x_axis + t.y_axis + t.z_axis), t.x_axis, t.y_axis, t.z_axis]
    }

    /// The gradient, and the positive semi-definite part of the second derivatives.
    pub(crate) fn derivatives(&self, x: &[DVec3; 4]) -> ([DVec3; 4], Block<12>) {
        let f = self.deformation(x);
        let (mu, lambda) = self.lame;
        let log = libm::log(f.determinant());
        let inverse_t = f.inverse().transpose();
        let stress = (f - inverse_t) * mu + inverse_t * (lambda * log);
        let g = self.gradients();
        let gradient = g.map(|g| stress * g * self.volume);
        let mut hessian = [[0.0; 12]; 12];
        for (value, of_vertices) in self.modes(&f, log) {
            let weight = value * self.volume;
            if weight > 0.0 {
                let mode: [f64; 12] = std::array::from_fn(|i| of_vertices[i / 3][i % 3]);
                for (row, scaled) in hessian.iter_mut().zip(mode.map(|entry| weight * entry)) {
                    for (entry, other) in row.iter_mut().zip(mode) {
                        *entry += scaled * other;
                    }
                }
            }
        }
        (gradient, hessian)
    }

    /// Eigenvalues of the second derivatives by F, and what their eigenvectors move the vertices by.
    ///
    /// The energy depends on the singular values of `F = U Σ Vᵀ` alone. For each pair of them one eigenvector shears and one turns, and three
    /// stretch, from a matrix of three rows (`smith_analytic_2019`).
    fn modes(&self, f: &DMat3, log: f64) -> [(f64, [DVec3; 4]); 9] {
        let (mu, lambda) = self.lame;
        let (u, sigma, v) = singular(f);
        let turned = self.gradients().map(|g| v.transpose() * g);
        let coupling = lambda * log - mu;
        let mut modes = [(0.0, [DVec3::ZERO; 4]); 9];
        for (k, [a, b]) in [[1, 2], [2, 0], [0, 1]].into_iter().enumerate() {
            let change = coupling / (sigma[a] * sigma[b]);
            let (first, second) = (u.col(a) * FRAC_1_SQRT_2, u.col(b) * FRAC_1_SQRT_2);
            modes[2 * k] = (mu - change, turned.map(|h| first * h[b] + second * h[a]));
            modes[2 * k + 1] = (mu + change, turned.map(|h| first * h[b] - second * h[a]));
        }
        let stiffness: Block<3> = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own = if i == j { mu - coupling / (sigma[i] * sigma[i]) } else { 0.0 };
                own + lambda / (sigma[i] * sigma[j])
            })
        });
        let (values, vectors) = eigen(stiffness);
        for (k, value) in values.into_iter().enumerate() {
            let stretched = |h: DVec3| u * DVec3::from_array(std::array::from_fn(|i| vectors[i][k] * h[i]));
            modes[6 + k] = (value, turned.map(stretched));
        }
        modes
    }
}

/// The singular value decomposition `U Σ Vᵀ` of a matrix of positive determinant, with rotations U and V.
fn singular(f: &DMat3) -> (DMat3, DVec3, DMat3) {
    let square = f.transpose() * *f;
    let entries: Block<3> = std::array::from_fn(|i| std::array::from_fn(|j| square.col(j)[i]));
    let (values, vectors) = eigen(entries);
    // The greatest two first: what is left follows from them without loss of digits.
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    let column = |k: usize| DVec3::new(vectors[0][k], vectors[1][k], vectors[2][k]);
    let (v0, v1) = (column(order[0]), column(order[1]));
    let v = DMat3::from_cols(v0, v1, v0.cross(v1));
    let u0 = (*f * v0).try_normalize().unwrap_or(DVec3::X);
    let across = *f * v1;
    let u1 = (across - u0 * u0.dot(across)).try_normalize().unwrap_or_else(|| u0.any_orthonormal_vector());
    let u = DMat3::from_cols(u0, u1, u0.cross(u1));
    let sigma = DVec3::from_array(std::array::from_fn(|k| u.col(k).dot(*f * v.col(k))));
    (u, sigma, v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::project;
    use crate::elastic::tests::{check, points};

    const REST: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];

    fn unit() -> Tetrahedron {
        Tetrahedron { vertices: [0, 1, 2, 3], inverse: DMat3::IDENTITY, volume: 1.0 / 6.0, lame: (2.0, 3.0) }
    }

    /// The second derivatives by the vertices, from the inverse of F, not from its singular values.
    fn by_f(tetrahedron: &Tetrahedron, f: DMat3) -> Block<9> {
        let ((mu, lambda), log) = (tetrahedron.lame, libm::log(f.determinant()));
        let (inverse, inverse_t) = (f.inverse(), f.inverse().transpose());
        let mut entries = [[0.0; 9]; 9];
        for column in 0..9 {
            let mut d = DMat3::ZERO;
            d.col_mut(column / 3)[column % 3] = 1.0;
            let product = inverse * d;
            let trace = product.x_axis.x + product.y_axis.y + product.z_axis.z;
            let turned = inverse_t * d.transpose() * inverse_t;
            let change = d * mu + turned * (mu - lambda * log) + inverse_t * (lambda * trace);
            for (row, entries) in entries.iter_mut().enumerate() {
                entries[column] = change.col(row / 3)[row % 3];
            }
        }
        entries
    }

    #[test]
    fn gradients_are_those_of_differences() {
        for seed in 0..8 {
            let noise: [DVec3; 4] = points(seed);
            let x: [DVec3; 4] = std::array::from_fn(|i| REST[i] + noise[i] * 0.3);
            check(x, |x| unit().energy(x), unit().derivatives(&x).0);
        }
    }

    #[test]
    fn second_derivatives_at_rest_are_those_of_differences() {
        // Nothing is negative there, so that nothing is projected away.
        let (_, hessian) = unit().derivatives(&REST);
        let h = 1e-5;
        for j in 0..12 {
            let moved = |by: f64| {
                let mut x = REST;
                x[j / 3][j % 3] += by;
                unit().derivatives(&x).0
            };
            let (low, high) = (moved(-h), moved(h));
            for i in 0..12 {
                let slope = (high[i / 3][i % 3] - low[i / 3][i % 3]) / (2.0 * h);
                assert!((slope - hessian[i][j]).abs() < 1e-7, "{i} {j}: {slope} {}", hessian[i][j]);
            }
        }
    }

    #[test]
    fn the_positive_part_is_that_of_an_eigenproblem_of_size_nine() {
        // Pulled, pressed, sheared, turned, noisy, and almost flat.
        let scaled = |x, y, z| [DVec3::ZERO, DVec3::X * x, DVec3::Y * y, DVec3::Z * z];
        let sheared = [DVec3::ZERO, DVec3::X, DVec3::Y + DVec3::X * 2.0, DVec3::Z];
        let turned = [DVec3::ZERO, DVec3::Y, -DVec3::X, DVec3::Z];
        let flat = scaled(1.0, 1.0, 1e-3);
        let mut cases = vec![
            REST,
            scaled(3.0, 2.0, 2.0),
            scaled(0.4, 0.4, 0.4),
            sheared,
            turned,
            scaled(2.0, 0.5, 0.5),
            flat,
        ];
        for seed in 0..40 {
            let noise: [DVec3; 4] = points(seed);
            let x: [DVec3; 4] = std::array::from_fn(|i| REST[i] * 0.7 + noise[i]);
            if unit().energy(&x).is_finite() {
                cases.push(x);
            }
        }
        let mut negative = 0;
        for x in cases {
            let mut expected = by_f(&unit(), unit().deformation(&x));
            let greatest =
                expected.iter().flatten().fold(0.0_f64, |m, e| if e.abs() > m { e.abs() } else { m });
            let before = expected;
            project(&mut expected);
            negative += usize::from(before != expected);
            // F is made of the last three vertices less the first.
            let (_, hessian) = unit().derivatives(&x);
            for i in 0..9 {
                for j in 0..9 {
                    let found = 6.0 * hessian[3 + i][3 + j];
                    let error = (found - expected[i][j]).abs();
                    assert!(error < 1e-11 * greatest, "{x:?} {i} {j}: {found} {}", expected[i][j]);
                }
            }
        }
        assert!(negative > 20, "{negative}");
    }
}
