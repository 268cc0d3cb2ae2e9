//! Second derivatives of barriers of pairs, and their positive semi-definite parts.

use crate::barrier::{cross_squared, cross_squared_hessian};
use crate::dense::project;
use crate::distance::Closest;
use glam::DVec3;

/// Second derivatives of a pair, three rows for each of four points.
#[derive(Clone, Debug)]
pub enum Curvature {
    /// A factor times the square of a vector.
    Rank1(f64, [f64; 12]),
    /// All entries.
    Full(Box<Matrix>),
}

/// Second derivatives by the coordinates of four points.
pub(crate) type Matrix = [[f64; 12]; 12];

/// What the second derivatives of `m b(d²)` are made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parts<'a> {
    pub(crate) closest: &'a Closest,
    pub(crate) x: &'a [DVec3; 4],
    /// The barrier and its derivatives by the squared distance.
    pub(crate) barrier: [f64; 3],
    /// The mollifier and its derivatives by `|u × v|²`.
    pub(crate) mollifier: [f64; 3],
}

fn flat(vectors: &[DVec3; 4]) -> [f64; 12] {
    std::array::from_fn(|i| vectors[i / 3][i % 3])
}

impl Parts<'_> {
    /// All second derivatives.
    pub(crate) fn full(&self) -> Matrix {
        let ([b, first, second], [m, slope, bend]) = (self.barrier, self.mollifier);
        let normal = flat(&self.closest.gradient());
        let hessian = self.closest.hessian(self.x);
        let mut full: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| m * (second * normal[i] * normal[j] + first * hessian[i][j]))
        });
        if self.is_mollified() {
            let across = flat(&cross_squared(self.x).1);
            let of_cross = cross_squared_hessian(self.x);
            for i in 0..12 {
                for j in 0..12 {
                    let mixed = normal[i] * across[j] + across[i] * normal[j];
                    let own = bend * across[i] * across[j] + slope * of_cross[i][j];
                    full[i][j] += slope * first * mixed + b * own;
                }
            }
        }
        full
    }

    /// Their nearest positive semi-definite matrix.
    pub(crate) fn positive(&self) -> Matrix {
        if self.is_mollified() {
            let mut full = self.full();
            project(&mut full);
            return full;
        }
        self.positive_of_distance()
    }

    fn is_mollified(&self) -> bool {
        self.mollifier[1] != 0.0
    }

    /// The nearest positive semi-definite matrix where the mollifier is 1. It lies in the span of the five vectors `w ⊗ n`, `w ⊗ t₁`,
    /// `w ⊗ t₂`, `w₁ ⊗ n`, `w₂ ⊗ n`, in which it has five rows.
    fn positive_of_distance(&self) -> Matrix {
        let Closest { weights, derivatives, free, vector, .. } = *self.closest;
        let [_, first, second] = self.barrier;
        let d = vector.length();
        let n = vector.normalize_or_zero();
        let (t1, t2) = n.try_normalize().map_or((DVec3::X, DVec3::Y), |n| n.any_orthonormal_pair());
        let [q, q1, q2] = orthonormal([weights, derivatives[0], derivatives[1]]);
        let dot = |a: &[f64; 4], b: &[f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let size = dot(&weights, &q);
        let (slopes, inverse) = self.closest.slopes_and_inverse(self.x);
        let column = |a: usize| {
            let (by, slope) = (&derivatives[a], slopes[a]);
            let along = |q: &[f64; 4]| 2.0 * d * dot(by, q);
            let across = [n, t1, t2].map(|t| 2.0 * size * slope.dot(t));
            [along(&q) + across[0], across[1], across[2], along(&q1), along(&q2)]
        };
        let columns = [column(0), column(1)];
        let mut small = [[0.0; 5]; 5];
        for (k, row) in small.iter_mut().enumerate().take(3) {
            row[k] = first * 2.0 * size * size;
        }
        small[0][0] += second * 4.0 * d * d * size * size;
        for a in 0..free {
            for b in 0..free {
                for i in 0..5 {
                    for j in 0..5 {
                        small[i][j] -= first * columns[a][i] * inverse[a][b] * columns[b][j];
                    }
                }
            }
        }
        project(&mut small);
        let outer = |q: &[f64; 4], v: DVec3| -> [f64; 12] { std::array::from_fn(|i| q[i / 3] * v[i % 3]) };
        let basis = [outer(&q, n), outer(&q, t1), outer(&q, t2), outer(&q1, n), outer(&q2, n)];
        expanded(&small, &basis)
    }
}

/// The matrix with these entries in an orthonormal basis.
fn expanded(small: &[[f64; 5]; 5], basis: &[[f64; 12]; 5]) -> Matrix {
    let mut full = [[0.0; 12]; 12];
    for (a, of_row) in basis.iter().enumerate() {
        let mut image = [0.0; 12];
        for (b, of_column) in basis.iter().enumerate() {
            for (sum, entry) in image.iter_mut().zip(of_column) {
                *sum += small[a][b] * entry;
            }
        }
        for (row, factor) in full.iter_mut().zip(of_row) {
            for (entry, value) in row.iter_mut().zip(image) {
                *entry += factor * value;
            }
        }
    }
    full
}

/// The part of a vector below which it depends on those before.
const DEPENDENT: f64 = 1e-12;

/// Orthonormal vectors with the span of three, by Gram and Schmidt twice; zero for one that depends on those before.
fn orthonormal(mut vectors: [[f64; 4]; 3]) -> [[f64; 4]; 3] {
    let length = |v: &[f64; 4]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    for k in 0..3 {
        let before = length(&vectors[k]);
        for _ in 0..2 {
            for i in 0..k {
                let earlier = vectors[i];
                let part: f64 = earlier.iter().zip(&vectors[k]).map(|(a, b)| a * b).sum();
                for (v, e) in vectors[k].iter_mut().zip(earlier) {
                    *v -= part * e;
                }
            }
        }
        let left = length(&vectors[k]);
        let factor = if left > DEPENDENT * before { 1.0 / left } else { 0.0 };
        for v in &mut vectors[k] {
            *v *= factor;
        }
    }
    vectors
}
