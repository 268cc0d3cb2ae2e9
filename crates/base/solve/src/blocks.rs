//! Symmetric matrices of blocks of three by three, whose pattern and symbolic analysis serve one matrix after another.

use crate::ordering::Ordering;
use crate::{Analysis, Cholesky, SolveError, SparseMatrix};

/// A symmetric matrix of blocks of three unknowns, such as the coordinates of a vertex, that is filled and factored again and again.
///
/// A matrix whose blocks are among those of the earlier ones takes over their pattern, with zeros where it has no block, and needs no
/// symbolic analysis. The bits of a solution therefore depend on the matrices before, too.
///
/// # Cost
/// Analysis by the graph of the blocks, which has a ninth of the entries; O(entries) for a matrix of known pattern.
///
/// # Example
/// ```
/// use pompeiu_solve::{LinearSolver, SymmetricBlocks};
///
/// let mut matrix = SymmetricBlocks::default();
/// matrix.clear(2, &[(0, 1)])?;
/// let identity = |a: usize, b: usize| if a == b { 1.0 } else { 0.0 };
/// matrix.add(0, 0, |a, b| 2.0 * identity(a, b));
/// matrix.add(1, 1, |a, b| 2.0 * identity(a, b));
/// matrix.add(1, 0, identity);
/// let mut x = [3.0; 6];
/// matrix.factor()?.solve_in_place(&mut x)?;
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
/// # Ok::<(), pompeiu_solve::SolveError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct SymmetricBlocks {
    /// For each column of blocks its first one in `rows`; one more than there are columns.
    starts: Vec<usize>,
    /// Rows of the blocks below the diagonal, ascending in each column. The blocks of the diagonal are always there.
    rows: Vec<u32>,
    /// The lower triangle, column by column: of its diagonal block first, then of each block below.
    values: Vec<f64>,
    analysis: Option<Analysis>,
}

impl SymmetricBlocks {
    /// Makes all values zero, for so many blocks on the diagonal, with blocks off it at these places and where earlier matrices had some.
    ///
    /// A place is the numbers of two blocks on the diagonal, in any order. With another number of blocks the earlier pattern is forgotten.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`] for a place outside the matrix.
    pub fn clear(&mut self, blocks: usize, places: &[(u32, u32)]) -> Result<(), SolveError> {
        if let Some(&(i, j)) = places.iter().find(|(i, j)| (*i).max(*j) as usize >= blocks) {
            let (row, column) = (i as usize, j as usize);
            return Err(SolveError::OutOfRange { row, column, rows: blocks, columns: blocks });
        }
        if self.starts.len() != blocks + 1 {
            (self.starts, self.rows, self.analysis) = (vec![0; blocks + 1], Vec::new(), None);
        }
        if !places.iter().all(|&(i, j)| i == j || self.place(i.min(j), i.max(j)).is_some()) {
            self.admit(places);
        }
        self.values.clear();
        self.values.resize(self.first(blocks), 0.0);
        Ok(())
    }

    /// Adds places to the pattern.
    fn admit(&mut self, places: &[(u32, u32)]) {
        let count = self.starts.len() - 1;
        let mut all: Vec<(u32, u32)> =
            places.iter().filter(|(i, j)| i != j).map(|&(i, j)| (i.min(j), i.max(j))).collect();
        for column in 0..count {
            all.extend(self.below(column).iter().map(|&row| (column as u32, row)));
        }
        all.sort_unstable();
        all.dedup();
        self.starts.fill(0);
        for &(column, _) in &all {
            self.starts[column as usize + 1] += 1;
        }
        for column in 0..count {
            self.starts[column + 1] += self.starts[column];
        }
        self.rows = all.into_iter().map(|(_, row)| row).collect();
        self.analysis = None;
    }

    /// The rows of blocks below the diagonal.
    fn below(&self, column: usize) -> &[u32] {
        &self.rows[self.starts[column]..self.starts[column + 1]]
    }

    /// The number of a block below the diagonal in its column.
    fn place(&self, column: u32, row: u32) -> Option<usize> {
        self.below(column as usize).binary_search(&row).ok()
    }

    /// The first value of a column of blocks.
    fn first(&self, column: usize) -> usize {
        6 * column + 9 * self.starts[column]
    }

    /// Adds to the block at a place; entries are asked for by row and column. Of a block on the diagonal only the lower triangle counts; a block
    /// off it counts once, as that below the diagonal.
    ///
    /// # Panics
    /// If [`clear`](Self::clear) was not told of the place.
    pub fn add(&mut self, row: u32, column: u32, entry: impl Fn(usize, usize) -> f64) {
        if row == column {
            let first = self.first(row as usize);
            let blocks = self.below(row as usize).len();
            for b in 0..3 {
                let of_column = first + [0, 3, 5][b] + 3 * blocks * b;
                for a in b..3 {
                    self.values[of_column + a - b] += entry(a, b);
                }
            }
            return;
        }
        let (low, high) = (row.min(column), row.max(column));
        let place = self.place(low, high).expect("a place that the pattern has");
        let (first, blocks) = (self.first(low as usize), self.below(low as usize).len());
        for b in 0..3 {
            let of_block = first + [0, 3, 5][b] + 3 * blocks * b + 3 - b + 3 * place;
            for a in 0..3 {
                self.values[of_block + a] += if row > column { entry(a, b) } else { entry(b, a) };
            }
        }
    }

    /// The lower triangle.
    ///
    /// # Errors
    /// [`SolveError::NonFinite`].
    pub fn matrix(&self) -> Result<SparseMatrix, SolveError> {
        let count = self.starts.len().saturating_sub(1);
        let mut starts = Vec::with_capacity(3 * count + 1);
        let mut row_indices = Vec::with_capacity(self.values.len());
        starts.push(0);
        for column in 0..count {
            for b in 0..3 {
                row_indices.extend(3 * column + b..3 * column + 3);
                for &row in self.below(column) {
                    row_indices.extend(3 * row as usize..3 * row as usize + 3);
                }
                starts.push(row_indices.len());
            }
        }
        SparseMatrix::from_parts(3 * count, starts, row_indices, self.values.clone())
    }

    /// An order of elimination by the graph of blocks, each with its three unknowns at once.
    fn ordering(&self) -> Result<Ordering, SolveError> {
        let count = self.starts.len().saturating_sub(1);
        let mut entries = Vec::with_capacity(count + self.rows.len());
        for column in 0..count {
            entries.push((column, column, 1.0));
            entries.extend(self.below(column).iter().map(|&row| (row as usize, column, 1.0)));
        }
        let graph = SparseMatrix::from_triplets(count, count, &entries)?;
        let order = Analysis::new(&graph, &Ordering::MinimumDegree)?.order();
        Ok(Ordering::Given(order.into_iter().flat_map(|block| 3 * block..3 * block + 3).collect()))
    }

    /// The factor of the matrix.
    ///
    /// # Errors
    /// Those of [`matrix`](Self::matrix), [`Analysis::new`] and [`Cholesky::with`].
    pub fn factor(&mut self) -> Result<Cholesky, SolveError> {
        let matrix = self.matrix()?;
        let analysis = match self.analysis.take() {
            Some(analysis) => analysis,
            None => Analysis::new(&matrix, &self.ordering()?)?,
        };
        let factor = Cholesky::with(&analysis, &matrix);
        self.analysis = Some(analysis);
        factor
    }
}
