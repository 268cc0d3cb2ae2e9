//! Small symmetric matrices: positive semi-definite parts by Jacobi's method.

/// The square of the part that rounding has of a matrix.
const NEGLIGIBLE: f64 = 1e-31;

/// Sweeps of Jacobi's method at most; it converges quadratically.
const SWEEPS: usize = 30;

/// Replaces a symmetric matrix by the nearest positive semi-definite one.
pub(crate) fn project<const N: usize>(matrix: &mut [[f64; N]; N]) {
    // Most matrices are definite, which elimination tells in a fraction of the time.
    if is_definite(*matrix) {
        return;
    }
    let (values, vectors) = eigen(*matrix);
    if values.iter().all(|value| *value >= 0.0) {
        return;
    }
    for i in 0..N {
        for j in 0..=i {
            let part =
                |k: usize| if values[k] > 0.0 { values[k] * vectors[i][k] * vectors[j][k] } else { 0.0 };
            let sum: f64 = (0..N).map(part).sum();
            matrix[i][j] = sum;
            matrix[j][i] = sum;
        }
    }
}

/// Whether all pivots of a symmetric matrix are positive.
fn is_definite<const N: usize>(mut a: [[f64; N]; N]) -> bool {
    for k in 0..N {
        let pivot = a[k][k];
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let row = a[k];
        for below in &mut a[k + 1..] {
            let factor = below[k] / pivot;
            for j in k + 1..N {
                below[j] -= factor * row[j];
            }
        }
    }
    true
}

/// Eigenvalues, and eigenvectors in columns.
pub(crate) fn eigen<const N: usize>(mut a: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut v = [[0.0; N]; N];
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..SWEEPS {
        let square = |i: usize, j: usize| a[i][j] * a[i][j];
        let off: f64 = (0..N).map(|i| (0..i).map(|j| square(i, j)).sum::<f64>()).sum();
        let diagonal: f64 = (0..N).map(|i| square(i, i)).sum();
        if off <= NEGLIGIBLE * diagonal {
            break;
        }
        for p in 0..N {
            for q in p + 1..N {
                if a[p][q] != 0.0 {
                    rotate(&mut a, &mut v, p, q);
                }
            }
        }
    }
    (std::array::from_fn(|i| a[i][i]), v)
}

/// Makes the entries at p, q and q, p zero.
fn rotate<const N: usize>(a: &mut [[f64; N]; N], v: &mut [[f64; N]; N], p: usize, q: usize) {
    let across = a[p][q];
    let theta = (a[q][q] - a[p][p]) / (2.0 * across);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    a[p][p] -= t * across;
    a[q][q] += t * across;
    (a[p][q], a[q][p]) = (0.0, 0.0);
    for k in 0..N {
        if k != p && k != q {
            let (x, y) = (a[k][p], a[k][q]);
            (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
            (a[p][k], a[q][k]) = (a[k][p], a[k][q]);
        }
        let (x, y) = (v[k][p], v[k][q]);
        (v[k][p], v[k][q]) = (c * x - s * y, s * x + c * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_known_eigenvalues_loses_the_negative_ones() {
        // Householder's reflection of diag(3, −2, 1).
        let u = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0_f64];
        let of = |d: [f64; 3]| -> [[f64; 3]; 3] {
            let q = |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * u[i] * u[j];
            std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| q(i, k) * d[k] * q(j, k)).sum()))
        };
        let mut matrix = of([3.0, -2.0, 1.0]);
        project(&mut matrix);
        for (row, expected) in matrix.iter().zip(of([3.0, 0.0, 1.0])) {
            assert!(row.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14));
        }
    }
}
