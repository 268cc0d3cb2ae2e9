//! Elastic energies of membranes and of bending, with gradients and positive semi-definite second derivatives.

use glam::{DMat2, DVec2, DVec3};

/// A membrane after Saint-Venant and Kirchhoff: `A (μ |E|² + λ/2 (tr E)²)`, `E = (FᵀF − I) / 2`; moduli times thickness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Membrane {
    pub(crate) vertices: [u32; 3],
    pub(crate) inverse: DMat2,
    pub(crate) area: f64,
    pub(crate) lame: (f64, f64),
}

/// An edge with two faces: `k (θ − θ₀)²`, with θ the angle of their normals (`grinspun_discrete_2003`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hinge {
    /// The edge, and the vertices opposite.
    pub(crate) vertices: [u32; 4],
    stiffness: f64,
    rest: f64,
}

/// Entry of a matrix of elements with N vertices.
pub(crate) type Block<const N: usize> = [[f64; N]; N];

impl Membrane {
    fn deformation(&self, x: &[DVec3; 3]) -> [DVec3; 2] {
        let (u, v, b) = (x[1] - x[0], x[2] - x[0], self.inverse);
        [u * b.x_axis.x + v * b.x_axis.y, u * b.y_axis.x + v * b.y_axis.y]
    }

    /// Green's strain: entries 11, 12, 22.
    fn strain(f: &[DVec3; 2]) -> [f64; 3] {
        [0.5 * (f[0].dot(f[0]) - 1.0), 0.5 * f[0].dot(f[1]), 0.5 * (f[1].dot(f[1]) - 1.0)]
    }

    pub(crate) fn energy(&self, x: &[DVec3; 3]) -> f64 {
        let [a, b, c] = Self::strain(&self.deformation(x));
        let (mu, lambda) = self.lame;
        self.area * (mu * (a * a + 2.0 * b * b + c * c) + 0.5 * lambda * (a + c) * (a + c))
    }

    pub(crate) fn derivatives(&self, x: &[DVec3; 3]) -> ([DVec3; 3], Block<9>) {
        let f = self.deformation(x);
        let [a, b, c] = Self::strain(&f);
        let (mu, lambda) = self.lame;
        let trace = lambda * (a + c);
        let s = [[2.0 * mu * a + trace, 2.0 * mu * b], [2.0 * mu * b, 2.0 * mu * c + trace]];
        let stress = [f[0] * s[0][0] + f[1] * s[1][0], f[0] * s[0][1] + f[1] * s[1][1]];
        let m = self.inverse;
        let g = [
            [-(m.x_axis.x + m.x_axis.y), -(m.y_axis.x + m.y_axis.y)],
            [m.x_axis.x, m.y_axis.x],
            [m.x_axis.y, m.y_axis.y],
        ];
        let gradient = g.map(|g| (stress[0] * g[0] + stress[1] * g[1]) * self.area);
        let mut hessian = [[0.0; 9]; 9];
        for (value, left, right) in self.modes(&f) {
            if value > 0.0 {
                let weight = value * self.area;
                let rows = g
                    .map(|g| left[0] * right[0].dot(DVec2::from(g)) + left[1] * right[1].dot(DVec2::from(g)));
                let mode: [f64; 9] = std::array::from_fn(|i| rows[i / 3][i % 3]);
                for (i, row) in hessian.iter_mut().enumerate() {
                    for (entry, other) in row.iter_mut().zip(mode) {
                        *entry += weight * mode[i] * other;
                    }
                }
            }
        }
        (gradient, hessian)
    }

    /// Eigenvalues and eigenvectors of the second derivatives by F; an eigenvector is `l₀ r₀ᵀ + l₁ r₁ᵀ`.
    ///
    /// The energy depends on the singular values `σ` of F alone, so that the eigenvectors follow from the singular vectors: two across the
    /// surface, two that turn and shear it, and two that stretch it, from a matrix of two rows (`smith_analytic_2019`).
    fn modes(&self, f: &[DVec3; 2]) -> [(f64, [DVec3; 2], [DVec2; 2]); 6] {
        let (mu, lambda) = self.lame;
        let along = main_axis(f[0].dot(f[0]), f[0].dot(f[1]), f[1].dot(f[1]));
        let v = [along, along.perp()];
        let stretched = v.map(|v| f[0] * v.x + f[1] * v.y);
        let u0 = stretched[0].try_normalize().unwrap_or(DVec3::X);
        let across = stretched[1] - u0 * u0.dot(stretched[1]);
        let u1 = across.try_normalize().unwrap_or_else(|| u0.any_orthonormal_vector());
        let (u, normal) = ([u0, u1], u0.cross(u1));
        let sigma = stretched.map(DVec3::length);
        let strain = sigma.map(|sigma| 0.5 * (sigma * sigma - 1.0));
        let stress = strain.map(|e| 2.0 * mu * e + lambda * (strain[0] + strain[1]));
        let (mean, half) = (0.5 * (stress[0] + stress[1]), std::f64::consts::FRAC_1_SQRT_2);
        let (sum, difference) = (sigma[0] + sigma[1], sigma[0] - sigma[1]);
        let (none, nowhere) = (DVec3::ZERO, DVec2::ZERO);
        let stiffness = |k: usize| stress[k] + sigma[k] * sigma[k] * (2.0 * mu + lambda);
        let (first, mixed, second) = (stiffness(0), lambda * sigma[0] * sigma[1], stiffness(1));
        let axis = main_axis(first, mixed, second);
        let stretch = |w: DVec2| {
            let value = w.x * (first * w.x + mixed * w.y) + w.y * (mixed * w.x + second * w.y);
            (value, [u[0] * w.x, u[1] * w.y], v)
        };
        [
            (stress[0], [normal, none], [v[0], nowhere]),
            (stress[1], [normal, none], [v[1], nowhere]),
            (mean + 0.5 * mu * difference * difference, [u[1] * half, u[0] * -half], v),
            (mean + 0.5 * mu * sum * sum, [u[1] * half, u[0] * half], v),
            stretch(axis),
            stretch(axis.perp()),
        ]
    }
}

/// The eigenvector of the greater eigenvalue of a symmetric matrix of two rows.
fn main_axis(a: f64, b: f64, c: f64) -> DVec2 {
    let half = 0.5 * (a - c);
    let root = half.hypot(b);
    // Of the two rows that are orthogonal to it, the one without cancellation.
    let axis = if half >= 0.0 { DVec2::new(half + root, b) } else { DVec2::new(b, root - half) };
    axis.try_normalize().unwrap_or(DVec2::X)
}

impl Hinge {
    pub(crate) fn new(vertices: [u32; 4], positions: &[DVec3], bending: f64) -> Self {
        let x = vertices.map(|v| positions[v as usize]);
        let edge = x[1] - x[0];
        let areas = 0.5 * (edge.cross(x[2] - x[0]).length() + edge.cross(x[3] - x[0]).length());
        // A third of both areas is the edge's: its width is that over its length.
        let stiffness = 1.5 * bending * edge.length_squared() / areas;
        Self { vertices, stiffness, rest: Self::angle(&x) }
    }

    /// The angle of the normals of both faces, signed by the edge.
    fn angle(x: &[DVec3; 4]) -> f64 {
        let e = x[1] - x[0];
        let (n, m) = (e.cross(x[2] - x[0]), (x[3] - x[0]).cross(e));
        libm::atan2(n.cross(m).dot(e.normalize_or_zero()), n.dot(m))
    }

    /// The bend beyond that at rest, in (−π, π].
    fn bend(&self, x: &[DVec3; 4]) -> f64 {
        use std::f64::consts::{PI, TAU};
        let bend = Self::angle(x) - self.rest;
        if bend > PI {
            bend - TAU
        } else if bend <= -PI {
            bend + TAU
        } else {
            bend
        }
    }

    pub(crate) fn energy(&self, x: &[DVec3; 4]) -> f64 {
        let bend = self.bend(x);
        self.stiffness * bend * bend
    }

    /// The gradient, and the gradient of the angle whose square, times twice the stiffness, is the positive part that is kept of the
    /// second derivatives.
    pub(crate) fn derivatives(&self, x: &[DVec3; 4]) -> ([DVec3; 4], [f64; 12], f64) {
        let e = x[1] - x[0];
        let length = e.length();
        let (n, m) = (e.cross(x[2] - x[0]), (x[3] - x[0]).cross(e));
        let (nn, mm) = (n.length_squared(), m.length_squared());
        let by_2 = n * (-length / nn);
        let by_3 = m * (-length / mm);
        let share = |p: DVec3| (p - x[0]).dot(e) / (length * length);
        let (s, t) = (share(x[2]), share(x[3]));
        let by_1 = by_2 * -s + by_3 * -t;
        let by_0 = by_2 * (s - 1.0) + by_3 * (t - 1.0);
        let by = [by_0, by_1, by_2, by_3];
        let factor = 2.0 * self.stiffness * self.bend(x);
        let mut angle = [0.0; 12];
        for (k, by) in by.iter().enumerate() {
            angle[3 * k..3 * k + 3].copy_from_slice(&by.to_array());
        }
        (by.map(|by| by * factor), angle, 2.0 * self.stiffness)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::dense::project;

    pub(crate) fn points<const N: usize>(seed: u64) -> [DVec3; N] {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        std::array::from_fn(|_| DVec3::new(next(), next(), next()))
    }

    pub(crate) fn check<const N: usize>(
        x: [DVec3; N],
        energy: impl Fn(&[DVec3; N]) -> f64,
        gradient: [DVec3; N],
    ) {
        let h = 1e-6;
        for i in 0..N {
            for k in 0..3 {
                let moved = |by: f64| {
                    let mut x = x;
                    x[i][k] += by;
                    energy(&x)
                };
                let slope = (moved(h) - moved(-h)) / (2.0 * h);
                assert!(
                    (slope - gradient[i][k]).abs() < 1e-6 * (1.0 + slope.abs()),
                    "{slope} {}",
                    gradient[i][k]
                );
            }
        }
    }

    #[test]
    fn gradients_are_those_of_differences() {
        let rest = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let membrane =
            Membrane { vertices: [0, 1, 2], inverse: DMat2::IDENTITY, area: 0.5, lame: (2.0, 3.0) };
        let hinge =
            Hinge::new([0, 1, 2, 3], &[DVec3::ZERO, DVec3::X, DVec3::Y, -DVec3::Y + DVec3::Z * 0.3], 0.7);
        for seed in 0..8 {
            let noise: [DVec3; 4] = points(seed);
            let x: [DVec3; 4] = std::array::from_fn(|i| rest[i] + noise[i] * 0.3);
            let y = [x[0], x[1], x[2]];
            check(y, |x| membrane.energy(x), membrane.derivatives(&y).0);
            let z = [x[0], x[1], x[2], -x[2] + x[3] * 0.2];
            check(z, |x| hinge.energy(x), hinge.derivatives(&z).0);
        }
    }

    #[test]
    fn the_positive_part_of_a_membrane_is_that_of_differences() {
        let membrane =
            Membrane { vertices: [0, 1, 2], inverse: DMat2::IDENTITY, area: 0.5, lame: (2.0, 3.0) };
        let h = 1e-5;
        let rest = [DVec3::ZERO, DVec3::X, DVec3::Y];
        // At rest, noisy, compressed, turned over in its plane, and shrunk to a segment and to a point.
        let shrunk = |x: f64, y: f64| [DVec3::ZERO, DVec3::X * x, DVec3::Y * y];
        let folded = [DVec3::ZERO, DVec3::X, DVec3::X * 0.7];
        let mut cases =
            vec![rest, shrunk(0.8, 0.6), shrunk(0.8, -0.9), shrunk(1.3, 0.4), folded, [DVec3::ZERO; 3]];
        for seed in 0..20 {
            let noise: [DVec3; 3] = points(seed);
            cases.push(std::array::from_fn(|i| rest[i] * 0.8 + noise[i]));
        }
        let mut negative = 0;
        for x in cases {
            let mut expected = [[0.0; 9]; 9];
            for j in 0..9 {
                let moved = |by: f64| {
                    let mut x = x;
                    x[j / 3][j % 3] += by;
                    membrane.derivatives(&x).0
                };
                let (low, high) = (moved(-h), moved(h));
                for (i, row) in expected.iter_mut().enumerate() {
                    row[j] = (high[i / 3][i % 3] - low[i / 3][i % 3]) / (2.0 * h);
                }
            }
            // Projected by F, which is x₁ − x₀ and x₂ − x₀ here.
            let mut by_f: Block<6> = std::array::from_fn(|i| std::array::from_fn(|j| expected[3 + i][3 + j]));
            let before = by_f;
            project(&mut by_f);
            negative += usize::from(before != by_f);
            let (_, hessian) = membrane.derivatives(&x);
            for i in 0..6 {
                for j in 0..6 {
                    let found = hessian[3 + i][3 + j];
                    assert!((found - by_f[i][j]).abs() < 1e-8, "{x:?} {i} {j}: {found} {}", by_f[i][j]);
                }
            }
            for (i, row) in hessian.iter().enumerate() {
                let sums = [0, 1, 2].map(|k| row[k] + row[3 + k] + row[6 + k]);
                assert!(sums.iter().all(|sum| sum.abs() < 1e-13), "{i}: {sums:?}");
            }
        }
        assert!(negative > 5, "{negative}");
    }
}
