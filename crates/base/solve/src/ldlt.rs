//! `LDLᵀ` factorization of symmetric matrices, without pivoting.

use crate::cholesky::{Analysis, buffer};
use crate::ordering::Ordering;
use crate::solver::LinearSolver;
use crate::{SolveError, SparseMatrix};
use faer::dyn_stack::MemStack;
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::cholesky::LdltRef;
use faer::{Conj, Par, Side};

/// The factors `L D Lᵀ` of a symmetric matrix that may be indefinite, with `D` diagonal.
///
/// # Accuracy
/// Without pivoting: stable for definite and quasi-definite matrices, `[A, Bᵀ; B, −C]` with `A` and `C` definite. Other matrices
/// may have small pivots and lose digits; check the residual, or use [`Lu`](crate::Lu).
/// # Limits
/// Only the lower triangle is read; symmetry is not checked.
/// # Source
/// The crate `faer`; orderings by approximate minimum degree.
#[derive(Clone, Debug)]
pub struct Ldlt {
    analysis: Analysis,
    values: Vec<f64>,
}

impl Ldlt {
    /// Factors a matrix, its unknowns ordered by approximate minimum degree.
    ///
    /// # Errors
    /// Those of [`Analysis::new`] and of [`with`](Self::with).
    pub fn new(matrix: &SparseMatrix) -> Result<Self, SolveError> {
        Self::with(&Analysis::new(matrix, &Ordering::MinimumDegree)?, matrix)
    }

    /// Factors a matrix whose pattern has been analysed.
    ///
    /// # Errors
    /// [`SolveError::OtherPattern`], [`SolveError::ZeroPivot`], [`SolveError::NoMemory`].
    pub fn with(analysis: &Analysis, matrix: &SparseMatrix) -> Result<Self, SolveError> {
        analysis.check(matrix)?;
        let symbolic = &analysis.symbolic;
        let mut values = analysis.empty_factor(matrix)?;
        let request = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let mut memory = buffer(request, matrix)?;
        symbolic
            .factorize_numeric_ldlt(
                &mut values,
                matrix.as_faer(),
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                faer::Spec::default(),
            )
            .map_err(|LdltError::ZeroPivot { index }| SolveError::ZeroPivot {
                index: analysis.unknown_at(index),
            })?;
        Ok(Self { analysis: analysis.clone(), values })
    }
}

impl LinearSolver for Ldlt {
    fn unknowns(&self) -> usize {
        self.analysis.symbolic.nrows()
    }

    fn solve_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let factor = LdltRef::new(&self.analysis.symbolic, &self.values);
        self.analysis.solve_columns(values, |columns, memory| {
            factor.solve_in_place_with_conj(Conj::No, columns, Par::Seq, memory);
        })
    }
}
