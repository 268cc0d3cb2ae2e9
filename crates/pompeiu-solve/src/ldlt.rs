//! `LDLᵀ` factorization of symmetric matrices, without pivoting.

use crate::cholesky::{Analysis, buffer, no_memory};
use crate::ordering::Ordering;
use crate::solver::{LinearSolver, columns, finite};
use crate::{SolveError, SparseMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::cholesky::LdltRef;
use faer::{Conj, MatMut, Par, Side};

/// The factors `L D Lᵀ` of a symmetric matrix that may be indefinite, with `D` diagonal.
///
/// # Accuracy
/// Without pivoting: stable for definite and quasi-definite matrices, `[A, Bᵀ; B, −C]` with `A` and `C` definite. For
/// others pivots may be small and digits lost; compare `A x` with the right-hand side, or use [`Lu`](crate::Lu).
/// # Limits
/// Only the lower triangle is read: that the matrix is symmetric is taken on trust.
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
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| no_memory(matrix))?;
        values.resize(symbolic.len_val(), 0.0);
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
        let n = self.unknowns();
        let count = columns(n, values)?;
        let symbolic = &self.analysis.symbolic;
        let request = symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut memory = MemBuffer::try_new(request)
            .map_err(|_| SolveError::NoMemory { unknowns: n, nonzeros: self.values.len() })?;
        LdltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(values, n, count),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        finite(n, values)
    }
}
