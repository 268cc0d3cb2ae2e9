//! LU factorization of banded matrices, with partial pivoting.

use crate::SolveError;

/// A square matrix whose entries lie within a band around the diagonal, to be filled and solved once.
///
/// # Cost
/// O(n · below · (below + above)); `n (2 below + above + 1)` numbers.
/// # Source
/// `golub_matrix_2013`, section 4.3.
#[derive(Clone, Debug)]
pub struct Banded {
    size: usize,
    below: usize,
    above: usize,
    /// Row by row, from `below` columns before the diagonal to `above + below` after it, where interchanges of rows may fill in.
    entries: Vec<f64>,
}

impl Banded {
    /// A matrix of zeros with so many diagonals below and above the main one.
    pub fn zeros(size: usize, below: usize, above: usize) -> Self {
        Self { size, below, above, entries: vec![0.0; size * (2 * below + above + 1)] }
    }

    fn width(&self) -> usize {
        2 * self.below + self.above + 1
    }

    fn at(&self, row: usize, column: usize) -> usize {
        row * self.width() + column + self.below - row
    }

    /// Adds to an entry.
    ///
    /// # Panics
    /// If the entry is outside the band.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        assert!(
            column < self.size && column <= row + self.above && row <= column + self.below,
            "row {row} and column {column} are outside the band"
        );
        let at = self.at(row, column);
        self.entries[at] += value;
    }

    /// The solution for a right-hand side, which it replaces. The matrix is used up.
    ///
    /// # Errors
    /// [`SolveError::Length`]; [`SolveError::Singular`] when a pivot is zero or no number.
    pub fn solve_in_place(mut self, b: &mut [f64]) -> Result<(), SolveError> {
        let n = self.size;
        if b.len() != n {
            return Err(SolveError::Length { what: "right-hand side", found: b.len(), expected: n });
        }
        for k in 0..n {
            let last = (k + self.below).min(n - 1);
            let size = |row: &usize| self.entries[self.at(*row, k)].abs();
            let pivot = (k..=last).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(k);
            let end = (k + self.below + self.above).min(n - 1);
            if pivot != k {
                for column in k..=end {
                    let (a, b) = (self.at(k, column), self.at(pivot, column));
                    self.entries.swap(a, b);
                }
                b.swap(k, pivot);
            }
            let head = self.entries[self.at(k, k)];
            if head == 0.0 || !head.is_finite() {
                return Err(SolveError::Singular { index: k });
            }
            for row in k + 1..=last {
                let factor = self.entries[self.at(row, k)] / head;
                if factor == 0.0 {
                    continue;
                }
                for column in k + 1..=end {
                    let from = self.entries[self.at(k, column)];
                    let to = self.at(row, column);
                    self.entries[to] -= factor * from;
                }
                b[row] -= factor * b[k];
            }
        }
        for k in (0..n).rev() {
            let end = (k + self.below + self.above).min(n - 1);
            let known: f64 = (k + 1..=end).map(|column| self.entries[self.at(k, column)] * b[column]).sum();
            b[k] = (b[k] - known) / self.entries[self.at(k, k)];
        }
        Ok(())
    }
}
