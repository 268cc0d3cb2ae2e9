//! Normal equations of point-to-plane distances.

use super::cholesky::solve;

/// The normal equations of linear least squares with `N` unknowns: rotation vector, translation and, as the seventh, scaling.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equations<const N: usize> {
    /// The lower triangle.
    pub(super) matrix: [[f64; N]; N],
    right: [f64; N],
}

impl<const N: usize> Equations<N> {
    pub(super) fn new() -> Self {
        Self { matrix: [[0.0; N]; N], right: [0.0; N] }
    }

    /// Adds the equation `row · x = right` with a weight.
    pub(super) fn add(&mut self, weight: f64, row: [f64; N], right: f64) {
        for i in 0..N {
            let weighted = weight * row[i];
            for j in 0..=i {
                self.matrix[i][j] += weighted * row[j];
            }
            self.right[i] += weighted * right;
        }
    }

    /// The solution, damped by a share of the mean diagonal entry; `None` if numbers overflow.
    pub(super) fn solved(&self, damping: f64) -> Option<[f64; N]> {
        let mean = (0..N).map(|i| self.matrix[i][i]).sum::<f64>() / N as f64;
        let mut matrix = self.matrix;
        for i in 0..N {
            matrix[i][i] += damping * mean;
        }
        solve(&matrix, &self.right)
    }

    /// A column of the inverse of the matrix; `None` if it is singular.
    pub(super) fn inverse_column<const K: usize>(&self) -> Option<[f64; N]> {
        solve(&self.matrix, &std::array::from_fn(|i| f64::from(u8::from(i == K))))
    }
}
