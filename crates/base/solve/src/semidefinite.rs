//! Semi-definite systems whose kernel consists of constants.

use crate::solver::{LinearSolver, columns};
use crate::{Cholesky, SolveError, SparseMatrix};

/// No group, or no place.
const NONE: usize = usize::MAX;

/// A symmetric positive semi-definite system whose kernel is spanned by the constants on some groups of unknowns.
///
/// Laplacians are of this kind: their groups are the connected components without a boundary condition. Nothing is added to the
/// matrix. Right-hand sides are projected onto its range by subtracting the mean of each group. Then one unknown of each group is
/// held at zero, which leaves a positive definite system with the same solutions up to constants. Of these, the solution with mean
/// zero on every group is returned; it has the least Euclidean norm. Other unknowns may be fixed at zero from the start.
///
/// # Accuracy
/// As [`Cholesky`]; [`solve_refined_in_place`](Self::solve_refined_in_place) adds a step of iterative refinement.
#[derive(Debug)]
pub struct SemidefiniteCholesky {
    matrix: SparseMatrix,
    /// For each unknown, the number of its group, or none.
    group: Vec<usize>,
    /// For each group, how many unknowns it has.
    sizes: Vec<usize>,
    /// The unknowns that are neither fixed nor held.
    free: Vec<usize>,
    fixed: Vec<usize>,
    cholesky: Cholesky,
}

impl SemidefiniteCholesky {
    /// Sets up and factors the system.
    ///
    /// # Shapes and units
    /// `fixed` and `group` have one entry per unknown: whether it is zero for every right-hand side, and the group, with constants
    /// in the kernel, to which it belongs. A fixed unknown belongs to no group.
    ///
    /// # Errors
    /// [`SolveError::Length`], [`SolveError::NotSquare`]; [`SolveError::NotPositiveDefinite`] if the kernel is larger than the
    /// groups imply.
    pub fn new(matrix: SparseMatrix, fixed: &[bool], group: &[Option<u32>]) -> Result<Self, SolveError> {
        matrix.check_square()?;
        let n = matrix.rows();
        for (what, found) in [("marks of fixed unknowns", fixed.len()), ("groups of unknowns", group.len())] {
            if found != n {
                return Err(SolveError::Length { what, found, expected: n });
            }
        }
        let groups = group.iter().flatten().max().map_or(0, |&last| last as usize + 1);
        let group: Vec<usize> = group
            .iter()
            .zip(fixed)
            .map(|(group, &fixed)| group.filter(|_| !fixed).map_or(NONE, |g| g as usize))
            .collect();
        let mut sizes = vec![0; groups];
        let mut free = Vec::with_capacity(n);
        for (i, &g) in group.iter().enumerate() {
            if g == NONE {
                if !fixed[i] {
                    free.push(i);
                }
                continue;
            }
            // The first unknown of a group is the one that is held.
            if sizes[g] > 0 {
                free.push(i);
            }
            sizes[g] += 1;
        }
        let fixed = (0..n).filter(|&i| fixed[i]).collect();
        let cholesky = Cholesky::new(&matrix.principal(&free)?).map_err(|error| match error {
            SolveError::NotPositiveDefinite { index } => {
                SolveError::NotPositiveDefinite { index: free[index] }
            }
            other => other,
        })?;
        Ok(Self { matrix, group, sizes, free, fixed, cholesky })
    }

    /// The matrix, all unknowns included.
    pub fn matrix(&self) -> &SparseMatrix {
        &self.matrix
    }

    /// Number of entries of the factor.
    pub fn factor_nonzeros(&self) -> usize {
        self.cholesky.analysis().factor_nonzeros()
    }

    /// The mean of the values of each group.
    fn means(&self, values: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.sizes.len()];
        for (&g, value) in self.group.iter().zip(values) {
            if g != NONE {
                sums[g] += value;
            }
        }
        sums.iter().zip(&self.sizes).map(|(sum, &size)| sum / size as f64).collect()
    }

    /// Subtracts the mean of each group and sets fixed unknowns to zero.
    ///
    /// This is the orthogonal projection onto the range of the system, and onto the complement of its kernel.
    ///
    /// # Panics
    /// If there is not one value per unknown.
    pub fn project(&self, values: &mut [f64]) {
        assert_eq!(values.len(), self.group.len(), "one value per unknown");
        let means = self.means(values);
        for (&g, value) in self.group.iter().zip(values.iter_mut()) {
            if g != NONE {
                *value -= means[g];
            }
        }
        for &i in &self.fixed {
            values[i] = 0.0;
        }
    }

    fn project_columns(&self, values: &mut [f64]) {
        for column in values.chunks_exact_mut(self.group.len()) {
            self.project(column);
        }
    }

    /// As [`solve_in_place`](LinearSolver::solve_in_place), followed by one step of iterative refinement: a second solve with the
    /// residual as right-hand side. Takes twice as long.
    ///
    /// # Errors
    /// Those of [`solve_in_place`](LinearSolver::solve_in_place).
    pub fn solve_refined_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let n = self.unknowns();
        if columns(n, values)? == 0 {
            return Ok(());
        }
        let mut x = values.to_vec();
        self.solve_in_place(&mut x)?;
        for (b, x) in values.chunks_exact_mut(n).zip(x.chunks_exact(n)) {
            for (b, ax) in b.iter_mut().zip(self.matrix.multiply(x)) {
                *b -= ax;
            }
        }
        self.solve_in_place(values)?;
        for (correction, x) in values.iter_mut().zip(x) {
            *correction += x;
        }
        Ok(())
    }

    /// Solves the reduced systems for projected right-hand sides.
    fn solve_reduced(&self, columns: &[f64]) -> Result<Vec<f64>, SolveError> {
        let n = self.group.len();
        let mut reduced: Vec<f64> =
            columns.chunks_exact(n).flat_map(|b| self.free.iter().map(|&i| b[i])).collect();
        self.cholesky.solve_in_place(&mut reduced)?;
        let mut x = vec![0.0; columns.len()];
        if !self.free.is_empty() {
            for (part, whole) in reduced.chunks_exact(self.free.len()).zip(x.chunks_exact_mut(n)) {
                for (&i, value) in self.free.iter().zip(part) {
                    whole[i] = *value;
                }
            }
        }
        Ok(x)
    }
}

impl LinearSolver for SemidefiniteCholesky {
    fn unknowns(&self) -> usize {
        self.group.len()
    }

    fn solve_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let n = self.unknowns();
        if columns(n, values)? == 0 {
            return Ok(());
        }
        self.project_columns(values);
        let x = self.solve_reduced(values)?;
        values.copy_from_slice(&x);
        self.project_columns(values);
        Ok(())
    }
}
