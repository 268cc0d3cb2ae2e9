//! Sparse matrices, column by column.

use crate::SolveError;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

/// A sparse matrix of finite numbers, stored by columns with rows in increasing order.
///
/// # Shapes and units
/// Any number of rows and columns; units are those of its entries. 16 bytes per entry.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    rows: usize,
    /// Where each column begins in the two arrays below, and where the last one ends.
    starts: Vec<usize>,
    row_indices: Vec<usize>,
    values: Vec<f64>,
}

impl SparseMatrix {
    /// The matrix with these entries (row, column, value); entries at the same place are added in the order given.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`], [`SolveError::NonFinite`] (also when a sum overflows).
    ///
    /// # Cost
    /// O(rows + columns + entries): two counting sorts.
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        entries: &[(usize, usize, f64)],
    ) -> Result<Self, SolveError> {
        let mut by_row = vec![0_usize; rows + 1];
        let mut starts = vec![0_usize; columns + 1];
        for &(row, column, value) in entries {
            if row >= rows || column >= columns {
                return Err(SolveError::OutOfRange { row, column, rows, columns });
            }
            if !value.is_finite() {
                return Err(SolveError::NonFinite { row, column, value });
            }
            by_row[row + 1] += 1;
            starts[column + 1] += 1;
        }
        accumulate(&mut by_row);
        accumulate(&mut starts);
        // Two stable sorts: by rows, then by columns.
        let mut sorted = vec![(0, 0, 0.0); entries.len()];
        for &entry in entries {
            let next = &mut by_row[entry.0];
            sorted[*next] = entry;
            *next += 1;
        }
        let mut next = starts.clone();
        let mut row_indices = vec![0; entries.len()];
        let mut values = vec![0.0; entries.len()];
        for (row, column, value) in sorted {
            row_indices[next[column]] = row;
            values[next[column]] = value;
            next[column] += 1;
        }
        let mut matrix = Self { rows, starts, row_indices, values };
        matrix.merge_equal_places()?;
        Ok(matrix)
    }

    /// The matrix of the quadratic form `Σ w (x_i − x_j)²` over these links (i, j, w): symmetric, with rows that add up to zero.
    ///
    /// Links between the same two unknowns add up; one from an unknown to itself adds nothing.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`], [`SolveError::NonFinite`].
    ///
    /// # Cost
    /// O(unknowns + links), several times quicker than [`from_triplets`](Self::from_triplets).
    pub fn from_links(unknowns: usize, links: &[(u32, u32, f64)]) -> Result<Self, SolveError> {
        let mut starts = vec![0_usize; unknowns + 1];
        let mut diagonal = vec![0.0; unknowns];
        for &(i, j, weight) in links {
            let (row, column) = (i as usize, j as usize);
            if row >= unknowns || column >= unknowns {
                return Err(SolveError::OutOfRange { row, column, rows: unknowns, columns: unknowns });
            }
            if !weight.is_finite() {
                return Err(SolveError::NonFinite { row, column, value: weight });
            }
            if i != j {
                starts[row + 1] += 1;
                starts[column + 1] += 1;
                diagonal[row] += weight;
                diagonal[column] += weight;
            }
        }
        for count in &mut starts[1..] {
            *count += 1;
        }
        accumulate(&mut starts);
        let mut next = starts.clone();
        let entries = starts[unknowns];
        let (mut row_indices, mut values) = (vec![0; entries], vec![0.0; entries]);
        let mut put = |row: usize, column: usize, value: f64| {
            let at = &mut next[column];
            row_indices[*at] = row;
            values[*at] = value;
            *at += 1;
        };
        for (i, &value) in diagonal.iter().enumerate() {
            if !value.is_finite() {
                return Err(SolveError::NonFinite { row: i, column: i, value });
            }
            put(i, i, value);
        }
        for &(i, j, weight) in links {
            if i != j {
                put(i as usize, j as usize, -weight);
                put(j as usize, i as usize, -weight);
            }
        }
        // Transposing sorts the rows of each column; a symmetric matrix stays the same otherwise.
        let mut matrix = Self { rows: unknowns, starts, row_indices, values }.transposed();
        matrix.merge_equal_places()?;
        Ok(matrix)
    }

    /// The square matrix with these columns; rows must be in increasing order.
    ///
    /// # Errors
    /// [`SolveError::NonFinite`].
    pub(crate) fn from_parts(
        rows: usize,
        starts: Vec<usize>,
        row_indices: Vec<usize>,
        values: Vec<f64>,
    ) -> Result<Self, SolveError> {
        if let Some(at) = values.iter().position(|x| !x.is_finite()) {
            let column = starts.partition_point(|&start| start <= at) - 1;
            return Err(SolveError::NonFinite { row: row_indices[at], column, value: values[at] });
        }
        Ok(Self { rows, starts, row_indices, values })
    }

    /// The diagonal matrix with these entries.
    ///
    /// # Errors
    /// [`SolveError::NonFinite`].
    pub fn diagonal(entries: &[f64]) -> Result<Self, SolveError> {
        let n = entries.len();
        if let Some(i) = entries.iter().position(|x| !x.is_finite()) {
            return Err(SolveError::NonFinite { row: i, column: i, value: entries[i] });
        }
        Ok(Self {
            rows: n,
            starts: (0..=n).collect(),
            row_indices: (0..n).collect(),
            values: entries.to_vec(),
        })
    }

    fn merge_equal_places(&mut self) -> Result<(), SolveError> {
        let mut kept = 0;
        let mut begin = 0;
        for column in 0..self.columns() {
            let end = self.starts[column + 1];
            let first = kept;
            for at in begin..end {
                let (row, value) = (self.row_indices[at], self.values[at]);
                if kept > first && self.row_indices[kept - 1] == row {
                    self.values[kept - 1] += value;
                    if !self.values[kept - 1].is_finite() {
                        return Err(SolveError::NonFinite { row, column, value: self.values[kept - 1] });
                    }
                } else {
                    self.row_indices[kept] = row;
                    self.values[kept] = value;
                    kept += 1;
                }
            }
            begin = end;
            self.starts[column + 1] = kept;
        }
        self.row_indices.truncate(kept);
        self.values.truncate(kept);
        Ok(())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of stored entries, zeros among them included.
    pub fn nonzeros(&self) -> usize {
        self.values.len()
    }

    /// The entries of a column as pairs of row and value, rows increasing.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn column(&self, column: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + '_ {
        let range = self.starts[column]..self.starts[column + 1];
        self.row_indices[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// All entries, column by column.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.columns()).flat_map(move |j| self.column(j).map(move |(i, value)| (i, j, value)))
    }

    /// An entry, zero where none is stored.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        if column >= self.columns() {
            return 0.0;
        }
        let begin = self.starts[column];
        match self.row_indices[begin..self.starts[column + 1]].binary_search(&row) {
            Ok(at) => self.values[begin + at],
            Err(_) => 0.0,
        }
    }

    /// The entries on the diagonal.
    pub fn diagonal_entries(&self) -> Vec<f64> {
        (0..self.rows.min(self.columns())).map(|i| self.get(i, i)).collect()
    }

    /// `A x`.
    ///
    /// # Panics
    /// If `x` does not have one value per column.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        assert_eq!(x.len(), self.columns(), "one value per column");
        let mut y = vec![0.0; self.rows];
        for (j, &xj) in x.iter().enumerate() {
            for (i, value) in self.column(j) {
                y[i] += value * xj;
            }
        }
        y
    }

    /// `Aᵀ x`.
    ///
    /// # Panics
    /// If `x` does not have one value per row.
    pub fn multiply_transposed(&self, x: &[f64]) -> Vec<f64> {
        assert_eq!(x.len(), self.rows, "one value per row");
        (0..self.columns()).map(|j| self.column(j).map(|(i, value)| value * x[i]).sum()).collect()
    }

    /// `Aᵀ`.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut starts = vec![0; self.rows + 1];
        for &i in &self.row_indices {
            starts[i + 1] += 1;
        }
        accumulate(&mut starts);
        let mut next = starts.clone();
        let mut row_indices = vec![0; self.nonzeros()];
        let mut values = vec![0.0; self.nonzeros()];
        for (i, j, value) in self.iter() {
            row_indices[next[i]] = j;
            values[next[i]] = value;
            next[i] += 1;
        }
        Self { rows: self.columns(), starts, row_indices, values }
    }

    /// `alpha A + beta B`.
    ///
    /// # Errors
    /// [`SolveError::Length`] if the two differ in size; [`SolveError::NonFinite`].
    pub fn combined(&self, alpha: f64, other: &Self, beta: f64) -> Result<Self, SolveError> {
        for (what, found, expected) in
            [("rows", other.rows, self.rows), ("columns", other.columns(), self.columns())]
        {
            if found != expected {
                return Err(SolveError::Length { what, found, expected });
            }
        }
        let scaled = |matrix: &Self, factor: f64| {
            matrix.iter().map(|(i, j, value)| (i, j, factor * value)).collect::<Vec<_>>()
        };
        let mut entries = scaled(self, alpha);
        entries.extend(scaled(other, beta));
        Self::from_triplets(self.rows, self.columns(), &entries)
    }

    /// The submatrix of the rows and columns with these indices, in this order; an index may occur more than once.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`] for an index outside the matrix.
    pub fn principal(&self, indices: &[usize]) -> Result<Self, SolveError> {
        const LEFT_OUT: usize = usize::MAX;
        let mut place = vec![LEFT_OUT; self.rows];
        for (new, &old) in indices.iter().enumerate() {
            if old >= self.rows.min(self.columns()) {
                let (rows, columns) = (self.rows, self.columns());
                return Err(SolveError::OutOfRange { row: old, column: old, rows, columns });
            }
            place[old] = new;
        }
        if indices.is_sorted_by(|a, b| a < b) {
            // Rows stay in order.
            let mut part = Self {
                rows: indices.len(),
                starts: Vec::with_capacity(indices.len() + 1),
                row_indices: Vec::with_capacity(self.nonzeros()),
                values: Vec::with_capacity(self.nonzeros()),
            };
            part.starts.push(0);
            for &old in indices {
                for (i, value) in self.column(old).filter(|&(i, _)| place[i] != LEFT_OUT) {
                    part.row_indices.push(place[i]);
                    part.values.push(value);
                }
                part.starts.push(part.values.len());
            }
            return Ok(part);
        }
        let entries: Vec<_> = indices
            .iter()
            .enumerate()
            .flat_map(|(new, &old)| self.column(old).map(move |(i, value)| (i, new, value)))
            .filter(|&(i, _, _)| place[i] != LEFT_OUT)
            .map(|(i, j, value)| (place[i], j, value))
            .collect();
        Self::from_triplets(indices.len(), indices.len(), &entries)
    }

    /// Checks that the matrix is square.
    pub(crate) fn check_square(&self) -> Result<(), SolveError> {
        let (rows, columns) = (self.rows, self.columns());
        if rows == columns { Ok(()) } else { Err(SolveError::NotSquare { rows, columns }) }
    }

    pub(crate) fn same_pattern(&self, starts: &[usize], row_indices: &[usize]) -> bool {
        self.starts == starts && self.row_indices == row_indices
    }

    pub(crate) fn pattern(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.row_indices)
    }

    pub(crate) fn as_faer(&self) -> SparseColMatRef<'_, usize, f64> {
        let pattern = SymbolicSparseColMatRef::new_checked(
            self.rows,
            self.columns(),
            &self.starts,
            None,
            &self.row_indices,
        );
        SparseColMatRef::new(pattern, &self.values)
    }
}

fn accumulate(counts: &mut [usize]) {
    for i in 1..counts.len() {
        counts[i] += counts[i - 1];
    }
}
