//! Eigenvalues of small dense matrices.

use crate::SolveError;
use faer::MatRef;

/// The eigenvalues of a square matrix that is given column by column, as pairs of real and imaginary part, in no particular order.
///
/// # Errors
/// [`SolveError::Length`] if there are not `size²` entries; [`SolveError::NonFinite`] for one that is no number;
/// [`SolveError::Singular`] if the iteration does not converge.
/// # Cost
/// O(size³).
/// # Source
/// The crate `faer`.
pub fn eigenvalues(size: usize, entries: &[f64]) -> Result<Vec<[f64; 2]>, SolveError> {
    let (found, expected) = (entries.len(), size.saturating_mul(size));
    if found != expected {
        return Err(SolveError::Length { what: "entries of a square matrix", found, expected });
    }
    if let Some(at) = entries.iter().position(|x| !x.is_finite()) {
        return Err(SolveError::NonFinite { row: at % size, column: at / size, value: entries[at] });
    }
    let values = MatRef::from_column_major_slice(entries, size, size)
        .eigenvalues()
        .map_err(|_| SolveError::Singular { index: 0 })?;
    Ok(values.into_iter().map(|value| [value.re, value.im]).collect())
}
