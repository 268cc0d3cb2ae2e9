//! The trait that all solvers implement.

use crate::SolveError;

/// A linear system that is ready to be solved for any right-hand side.
pub trait LinearSolver: Send + Sync {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Replaces right-hand sides, one after the other in one slice, by their solutions.
    ///
    /// # Errors
    /// [`SolveError::Length`] if the slice does not hold a whole number of right-hand sides;
    /// [`SolveError::NonFiniteRightHandSide`]; [`SolveError::Singular`] if no finite solution came out.
    fn solve_in_place(&self, columns: &mut [f64]) -> Result<(), SolveError>;

    /// The solution for one right-hand side.
    ///
    /// # Errors
    /// Those of [`solve_in_place`](Self::solve_in_place), and [`SolveError::Length`] for anything but one column.
    fn solve(&self, right_hand_side: &[f64]) -> Result<Vec<f64>, SolveError> {
        let (found, expected) = (right_hand_side.len(), self.unknowns());
        if found != expected {
            return Err(SolveError::Length { what: "values of the right-hand side", found, expected });
        }
        let mut x = right_hand_side.to_vec();
        self.solve_in_place(&mut x)?;
        Ok(x)
    }
}

/// The number of right-hand sides in a slice; checks that all are finite.
pub(crate) fn columns(unknowns: usize, values: &[f64]) -> Result<usize, SolveError> {
    let count = values.len().checked_div(unknowns).unwrap_or(0);
    if count * unknowns != values.len() {
        let (found, expected) = (values.len(), (count + 1) * unknowns);
        return Err(SolveError::Length { what: "values of right-hand sides", found, expected });
    }
    match values.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(SolveError::NonFiniteRightHandSide { index, value: values[index] }),
        None => Ok(count),
    }
}

/// Checks that a solution is finite.
pub(crate) fn finite(unknowns: usize, solution: &[f64]) -> Result<(), SolveError> {
    match solution.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(SolveError::Singular { index: at % unknowns }),
        None => Ok(()),
    }
}
