//! LU factorization of square matrices, with partial pivoting.

use crate::cholesky::{buffer, no_memory};
use crate::solver::{LinearSolver, columns, finite};
use crate::{SolveError, SparseMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, MatMut, Par};

/// The factors of a square matrix: `P A Q = L U`.
///
/// # Source
/// The crate `faer`; columns ordered by approximate minimum degree, rows by partial pivoting.
#[derive(Debug)]
pub struct Lu {
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
}

impl Lu {
    /// Factors a matrix.
    ///
    /// # Errors
    /// [`SolveError::NotSquare`], [`SolveError::NoMemory`], and [`SolveError::Singular`] if the pattern shows it
    /// (if only the values do, solving says so).
    pub fn new(matrix: &SparseMatrix) -> Result<Self, SolveError> {
        matrix.check_square()?;
        let a = matrix.as_faer();
        let symbolic = factorize_symbolic_lu(a.symbolic(), LuSymbolicParams::default())
            .map_err(|_| no_memory(matrix))?;
        let request = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, faer::Spec::default());
        let mut memory = buffer(request, matrix)?;
        let mut numeric = NumericLu::new();
        symbolic
            .factorize_numeric_lu(
                &mut numeric,
                a,
                Par::Seq,
                MemStack::new(&mut memory),
                faer::Spec::default(),
            )
            .map_err(|error| match error {
                LuError::SymbolicSingular { index } => SolveError::Singular {
                    index: symbolic.col_perm().arrays().0.get(index).copied().unwrap_or(index),
                },
                LuError::Generic(_) => no_memory(matrix),
            })?;
        Ok(Self { symbolic, numeric })
    }
}

impl LinearSolver for Lu {
    fn unknowns(&self) -> usize {
        self.symbolic.nrows()
    }

    fn solve_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let n = self.unknowns();
        let count = columns(n, values)?;
        let request = self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut memory =
            MemBuffer::try_new(request).map_err(|_| SolveError::NoMemory { unknowns: n, nonzeros: 0 })?;
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(values, n, count),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        finite(n, values)
    }
}
