//! Factorizations, which take the longest, and are given up where the control stops.

use super::error::TransportError;
use pompeiu_core::run::{Control, StopReason, unless_stopped};
use pompeiu_solve::{Cholesky, Lu, SparseMatrix};

/// The factors of a matrix; `None` where the control stops first.
pub(super) fn lu(matrix: SparseMatrix, control: &Control) -> Result<Option<Lu>, TransportError> {
    Ok(unless_stopped(control, move || Lu::new(&matrix)).transpose()?)
}

/// The factors of a symmetric, positive definite matrix, with the matrix.
///
/// # Errors
/// [`TransportError::Stopped`] where the control stops first; [`TransportError::Solve`].
pub(super) fn cholesky(
    matrix: SparseMatrix,
    control: &Control,
) -> Result<(Cholesky, SparseMatrix), TransportError> {
    let factored = unless_stopped(control, move || Cholesky::new(&matrix).map(|factors| (factors, matrix)));
    Ok(factored.ok_or_else(|| stopped(control))??)
}

/// An error if the computation should stop.
pub(super) fn go_on(control: &Control) -> Result<(), TransportError> {
    if control.is_stopped() { Err(stopped(control)) } else { Ok(()) }
}

fn stopped(control: &Control) -> TransportError {
    TransportError::Stopped(control.reason().unwrap_or(StopReason::Cancelled))
}
