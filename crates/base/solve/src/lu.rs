//! LU factorization of square matrices, with partial pivoting.

use crate::cholesky::{buffer, no_memory};
use crate::solver::{LinearSolver, columns, finite};
use crate::{SolveError, SparseMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, MatMut, Par};

/// A matrix counts as singular if its componentwise condition number exceeds this: relative changes of its entries by `2^-50`, a
/// few rounding units, then make it singular.
const LARGEST_CONDITION: f64 = (1_u64 << 50) as f64;

/// Steps of the power iteration that estimates the condition number; the first only finds the scale of the unknowns.
const STEPS: usize = 3;

/// Sign vectors tried in each step.
const SIGNS: usize = 4;

/// The factors of a square matrix: `P A Q = L U`.
///
/// # Accuracy
/// Backward stable where partial pivoting is. A matrix that is singular to working precision is rejected: after factoring, the
/// componentwise condition number `ρ(|A⁻¹| |A|)`, which is invariant under scaling of rows and columns, is estimated by a few
/// solves.
/// # Limits
/// The estimate of the condition number is a lower bound: a matrix that is singular up to rounding may be accepted.
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
    /// [`SolveError::NotSquare`], [`SolveError::NoMemory`]; [`SolveError::Singular`] if the matrix is singular to working
    /// precision.
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
        let lu = Self { symbolic, numeric };
        lu.check_condition(matrix)?;
        Ok(lu)
    }

    /// Rejects a matrix whose componentwise condition number is too large.
    ///
    /// A power iteration with `|A⁻¹| |A|`. The absolute values of `A⁻¹` are unknown, so each step solves for `|A| x` with several
    /// choices of signs and adds the absolute values of the solutions.
    fn check_condition(&self, matrix: &SparseMatrix) -> Result<(), SolveError> {
        let n = matrix.rows();
        let mut x = vec![1.0; n];
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        for step in 0..STEPS {
            let mut y = vec![0.0; n];
            for (i, j, value) in matrix.iter() {
                y[i] += value.abs() * x[j];
            }
            let mut columns = Vec::with_capacity(SIGNS * n);
            for _ in 0..SIGNS {
                columns.extend(y.iter().map(|value| {
                    state =
                        state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    if state >> 63 == 1 { -value } else { *value }
                }));
            }
            self.solve_in_place(&mut columns)?;
            let (mut index, mut largest) = (0, 0.0);
            for (i, value) in y.iter_mut().enumerate() {
                *value = (0..SIGNS).map(|k| columns[k * n + i].abs() / SIGNS as f64).sum();
                if *value > largest {
                    (index, largest) = (i, *value);
                }
            }
            if step > 0 && largest > LARGEST_CONDITION {
                return Err(SolveError::Singular { index });
            }
            if largest > 0.0 {
                x = y.iter().map(|value| value / largest).collect();
            }
        }
        Ok(())
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
