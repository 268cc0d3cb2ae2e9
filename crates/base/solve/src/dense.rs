//! Cholesky factorization of small dense matrices.

use crate::SolveError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltError, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{MatMut, MatRef, Par, Spec};
use rayon::prelude::*;

/// Columns per task; fixed, so that bits do not depend on the number of threads.
const COLUMNS: usize = 256;

/// The factor L of a dense symmetric positive definite matrix `L Lᵀ`.
///
/// Columns are solved for in parallel, with the same bits at any number of threads.
///
/// # Cost
/// O(n³) to factor, O(n²) for each column.
/// # Source
/// The crate `faer`.
#[derive(Clone, Debug)]
pub struct DenseCholesky {
    size: usize,
    factor: Vec<f64>,
}

impl DenseCholesky {
    /// Factors a matrix that is given column by column; only its lower triangle is read.
    ///
    /// # Errors
    /// [`SolveError::Length`] if there are not `size²` entries; [`SolveError::NotPositiveDefinite`],
    /// [`SolveError::NoMemory`].
    pub fn new(size: usize, mut entries: Vec<f64>) -> Result<Self, SolveError> {
        let (found, expected) = (entries.len(), size.saturating_mul(size));
        if found != expected {
            return Err(SolveError::Length { what: "entries of a square matrix", found, expected });
        }
        let request = cholesky_in_place_scratch::<f64>(size, Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(request)
            .map_err(|_| SolveError::NoMemory { unknowns: size, nonzeros: expected })?;
        cholesky_in_place(
            MatMut::from_column_major_slice_mut(&mut entries, size, size),
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        )
        .map_err(|LltError::NonPositivePivot { index }| SolveError::NotPositiveDefinite { index })?;
        Ok(Self { size, factor: entries })
    }

    /// Replaces columns, stored one after the other in one slice, by `L⁻¹` times them.
    ///
    /// # Errors
    /// [`SolveError::Length`] if the slice does not hold a whole number of columns.
    pub fn solve_lower_in_place(&self, columns: &mut [f64]) -> Result<(), SolveError> {
        let n = self.size;
        let count = columns.len().checked_div(n).unwrap_or(0);
        if count * n != columns.len() {
            let (found, expected) = (columns.len(), (count + 1) * n);
            return Err(SolveError::Length { what: "values of columns", found, expected });
        }
        if count > 0 {
            let factor = MatRef::from_column_major_slice(&self.factor, n, n);
            columns.par_chunks_mut(COLUMNS * n).for_each(|part| {
                let count = part.len() / n;
                let part = MatMut::from_column_major_slice_mut(part, n, count);
                solve_lower_triangular_in_place(factor, part, Par::Seq);
            });
        }
        Ok(())
    }
}
