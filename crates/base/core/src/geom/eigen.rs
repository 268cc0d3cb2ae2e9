//! Principal axes of symmetric matrices.

use glam::{DMat3, DVec3};

/// Enough sweeps for the off-diagonal part of a small matrix to vanish: each at least squares a small remainder.
const SWEEPS: usize = 12;

/// Unit eigenvectors of a symmetric matrix, that of the largest eigenvalue first, as the columns of a rotation.
pub fn eigenvectors(symmetric: DMat3) -> DMat3 {
    let [(_, first), (_, second), _] = eigenpairs(symmetric.to_cols_array_2d());
    let [first, second] = [first, second].map(DVec3::from_array);
    DMat3::from_cols(first, second, first.cross(second))
}

/// Eigenvalues of a symmetric matrix with their unit eigenvectors, the largest first.
///
/// # Source
/// The cyclic Jacobi method, `golub_matrix_2013`, section 8.5: for small matrices it is short, accurate, and the same on every
/// machine.
pub fn eigenpairs<const N: usize>(symmetric: [[f64; N]; N]) -> [(f64, [f64; N]); N] {
    let mut a = symmetric;
    let mut v: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for _ in 0..SWEEPS {
        for p in 0..N {
            for q in p + 1..N {
                if a[p][q] != 0.0 {
                    rotate(&mut a, &mut v, p, q);
                }
            }
        }
    }
    let mut pairs: [(f64, [f64; N]); N] = std::array::from_fn(|i| (a[i][i], v[i]));
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

/// Eliminates one off-diagonal entry. `v` holds the eigenvectors, one after the other.
fn rotate<const N: usize>(a: &mut [[f64; N]; N], v: &mut [[f64; N]; N], p: usize, q: usize) {
    let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let sign = if tau >= 0.0 { 1.0 } else { -1.0 };
    let t = if tau.is_finite() { sign / (tau.abs() + (1.0 + tau * tau).sqrt()) } else { 0.0 };
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;
    for row in a.iter_mut() {
        let (x, y) = (row[p], row[q]);
        (row[p], row[q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..N {
        let (x, y) = (a[p][k], a[q][k]);
        (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
        let (x, y) = (v[p][k], v[q][k]);
        (v[p][k], v[q][k]) = (c * x - s * y, s * x + c * y);
    }
    (a[p][q], a[q][p]) = (0.0, 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Random;

    #[test]
    fn finds_the_axes_of_random_matrices() {
        let mut random = Random::new(3);
        for _ in 0..500 {
            let x: [f64; 6] = std::array::from_fn(|_| random.signed_unit());
            let a = DMat3::from_cols_array(&[x[0], x[1], x[2], x[1], x[3], x[4], x[2], x[4], x[5]]);
            let v = eigenvectors(a);
            assert!((v.determinant() - 1.0).abs() < 1e-14);
            let d = v.transpose() * a * v;
            let [d0, d1, d2] = [d.x_axis.x, d.y_axis.y, d.z_axis.z];
            assert!(d0 >= d1 - 1e-14 && d1 >= d2 - 1e-14);
            let off = [d.x_axis.y, d.x_axis.z, d.y_axis.z];
            assert!(off.iter().all(|x| x.abs() < 1e-14), "{off:?}");
        }
        assert_eq!(eigenvectors(DMat3::ZERO), DMat3::IDENTITY);
    }
}
