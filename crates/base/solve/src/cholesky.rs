//! Cholesky factorization of symmetric positive definite matrices.

use crate::ordering::Ordering;
use crate::solver::{LinearSolver, columns, finite};
use crate::{SolveError, SparseMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError as Pivot;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side};
use std::sync::Arc;

/// The symbolic analysis of a symmetric matrix: elimination order and nonzero pattern of the factor.
///
/// Matrices with the same pattern share one, as in the time steps of a flow.
#[derive(Clone, Debug)]
pub struct Analysis {
    starts: Arc<[usize]>,
    row_indices: Arc<[usize]>,
    pub(crate) symbolic: Arc<SymbolicCholesky<usize>>,
}

impl Analysis {
    /// Analyses the pattern of a symmetric matrix; its values are ignored.
    ///
    /// # Errors
    /// [`SolveError::NotSquare`], [`SolveError::NoMemory`]; [`SolveError::Length`] or [`SolveError::OutOfRange`] when a given order
    /// is not a permutation.
    pub fn new(matrix: &SparseMatrix, ordering: &Ordering) -> Result<Self, SolveError> {
        matrix.check_square()?;
        let n = matrix.rows();
        let (natural, inverse): (Vec<usize>, Vec<usize>);
        let order = match ordering {
            Ordering::MinimumDegree => SymmetricOrdering::Amd,
            Ordering::Natural => {
                // Without an ordering the library would read both triangles where it expects one.
                natural = (0..n).collect();
                SymmetricOrdering::Custom(PermRef::new_checked(&natural, &natural, n))
            }
            Ordering::Given(order) => {
                inverse = inverse_of(order, n)?;
                SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, n))
            }
        };
        let symbolic = factorize_symbolic_cholesky(
            matrix.as_faer().symbolic(),
            Side::Lower,
            order,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| no_memory(matrix))?;
        let (starts, row_indices) = matrix.pattern();
        Ok(Self { starts: starts.into(), row_indices: row_indices.into(), symbolic: Arc::new(symbolic) })
    }

    /// The unknowns in the order of their elimination.
    pub fn order(&self) -> Vec<usize> {
        match self.symbolic.perm() {
            Some(order) => order.arrays().0.to_vec(),
            None => (0..self.symbolic.nrows()).collect(),
        }
    }

    /// Number of entries of the factor.
    pub fn factor_nonzeros(&self) -> usize {
        self.symbolic.len_val()
    }

    pub(crate) fn check(&self, matrix: &SparseMatrix) -> Result<(), SolveError> {
        if matrix.same_pattern(&self.starts, &self.row_indices) {
            Ok(())
        } else {
            Err(SolveError::OtherPattern)
        }
    }

    /// A zeroed array for the entries of a factor.
    pub(crate) fn empty_factor(&self, matrix: &SparseMatrix) -> Result<Vec<f64>, SolveError> {
        let mut values = Vec::new();
        values.try_reserve_exact(self.symbolic.len_val()).map_err(|_| no_memory(matrix))?;
        values.resize(self.symbolic.len_val(), 0.0);
        Ok(values)
    }

    /// Solves for the columns of `values` with a factor; allocates the scratch memory and checks that the result is finite.
    pub(crate) fn solve_columns(
        &self,
        values: &mut [f64],
        solve: impl FnOnce(MatMut<'_, f64>, &mut MemStack),
    ) -> Result<(), SolveError> {
        let n = self.symbolic.nrows();
        let count = columns(n, values)?;
        let request = self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut memory = MemBuffer::try_new(request)
            .map_err(|_| SolveError::NoMemory { unknowns: n, nonzeros: self.factor_nonzeros() })?;
        solve(MatMut::from_column_major_slice_mut(values, n, count), MemStack::new(&mut memory));
        finite(n, values)
    }

    /// The unknown that is eliminated at the step that failed.
    pub(crate) fn unknown_at(&self, reported: usize) -> usize {
        // The column-by-column method counts its steps from one.
        let step = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(_) => reported.saturating_sub(1),
            SymbolicCholeskyRaw::Supernodal(_) => reported,
        };
        match self.symbolic.perm() {
            Some(order) => order.arrays().0.get(step).copied().unwrap_or(step),
            None => step,
        }
    }
}

fn inverse_of(order: &[usize], n: usize) -> Result<Vec<usize>, SolveError> {
    if order.len() != n {
        return Err(SolveError::Length { what: "indices in the order", found: order.len(), expected: n });
    }
    let mut inverse = vec![usize::MAX; n];
    for (step, &i) in order.iter().enumerate() {
        match inverse.get_mut(i) {
            Some(place) if *place == usize::MAX => *place = step,
            _ => return Err(SolveError::OutOfRange { row: i, column: i, rows: n, columns: n }),
        }
    }
    Ok(inverse)
}

#[cold]
pub(crate) fn no_memory(matrix: &SparseMatrix) -> SolveError {
    SolveError::NoMemory { unknowns: matrix.rows(), nonzeros: matrix.nonzeros() }
}

pub(crate) fn buffer(
    request: faer::dyn_stack::StackReq,
    matrix: &SparseMatrix,
) -> Result<MemBuffer, SolveError> {
    MemBuffer::try_new(request).map_err(|_| no_memory(matrix))
}

/// The Cholesky factor of a symmetric positive definite matrix.
///
/// # Accuracy
/// Backward stable: the solution is that of a matrix that differs from the given one by a few units of rounding times its
/// size. How far it is from the true solution depends on the condition of the matrix.
/// # Limits
/// Only the lower triangle is read; symmetry is not checked.
/// # Source
/// The crate `faer`; orderings by approximate minimum degree.
#[derive(Clone, Debug)]
pub struct Cholesky {
    analysis: Analysis,
    values: Vec<f64>,
}

impl Cholesky {
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
    /// [`SolveError::OtherPattern`], [`SolveError::NotPositiveDefinite`], [`SolveError::NoMemory`].
    pub fn with(analysis: &Analysis, matrix: &SparseMatrix) -> Result<Self, SolveError> {
        analysis.check(matrix)?;
        let symbolic = &analysis.symbolic;
        let mut values = analysis.empty_factor(matrix)?;
        let request = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let mut memory = buffer(request, matrix)?;
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_faer(),
                Side::Lower,
                faer::linalg::cholesky::llt::factor::LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                faer::Spec::default(),
            )
            .map_err(|Pivot::NonPositivePivot { index }| SolveError::NotPositiveDefinite {
                index: analysis.unknown_at(index),
            })?;
        Ok(Self { analysis: analysis.clone(), values })
    }

    /// The symbolic analysis.
    pub fn analysis(&self) -> &Analysis {
        &self.analysis
    }
}

impl LinearSolver for Cholesky {
    fn unknowns(&self) -> usize {
        self.analysis.symbolic.nrows()
    }

    fn solve_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let factor = LltRef::new(&self.analysis.symbolic, &self.values);
        self.analysis.solve_columns(values, |columns, memory| {
            factor.solve_in_place_with_conj(Conj::No, columns, Par::Seq, memory);
        })
    }
}
