//! Repeated assembly of matrices from elements with the same unknowns.

use crate::{SolveError, SparseMatrix};

/// An unknown with a fixed value: its rows and columns are omitted.
pub const FIXED: u32 = u32::MAX;

/// Maps the entries of element matrices to the entries of the global matrix.
///
/// Computed once, it serves every matrix that is assembled from the same elements: in each step of a flow, for instance. All those
/// matrices have the same pattern, so one [`Analysis`](crate::Analysis) serves them, too.
///
/// # Shapes and units
/// `K` unknowns in each of m elements; 4 K² bytes per element.
#[derive(Clone, Debug)]
pub struct ElementPattern<const K: usize> {
    unknowns: usize,
    starts: Vec<usize>,
    row_indices: Vec<usize>,
    /// For each element the indices of its entries among the values; [`FIXED`] for entries of fixed unknowns.
    places: Vec<[[u32; K]; K]>,
}

impl<const K: usize> ElementPattern<K> {
    /// The pattern of elements with these unknowns; [`FIXED`] stands for none.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`] for an unknown that does not exist.
    /// # Cost
    /// O(K² m log K).
    pub fn new(unknowns: usize, elements: &[[u32; K]]) -> Result<Self, SolveError> {
        // Every unknown has a diagonal entry.
        let mut starts = vec![1_usize; unknowns + 1];
        starts[0] = 0;
        for &unknown in elements.iter().flatten().filter(|&&unknown| unknown != FIXED) {
            let Some(count) = starts.get_mut(unknown as usize + 1) else {
                let (row, column) = (unknown as usize, unknown as usize);
                return Err(SolveError::OutOfRange { row, column, rows: unknowns, columns: unknowns });
            };
            *count += K;
        }
        for i in 0..unknowns {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut gathered = vec![0_u32; starts[unknowns]];
        for (column, at) in next[..unknowns].iter_mut().enumerate() {
            gathered[*at] = column as u32;
            *at += 1;
        }
        for element in elements {
            for &column in element.iter().filter(|&&column| column != FIXED) {
                let at = &mut next[column as usize];
                // A fixed row is replaced by the diagonal; duplicates are removed below.
                for (k, &row) in element.iter().enumerate() {
                    gathered[*at + k] = if row == FIXED { column } else { row };
                }
                *at += K;
            }
        }
        let mut row_indices = Vec::with_capacity(gathered.len() / 2);
        let mut merged = Vec::with_capacity(unknowns + 1);
        merged.push(0);
        for column in 0..unknowns {
            let rows = &mut gathered[starts[column]..starts[column + 1]];
            rows.sort_unstable();
            let from = row_indices.len();
            for &row in rows.iter() {
                if row_indices.len() == from || row_indices.last() != Some(&(row as usize)) {
                    row_indices.push(row as usize);
                }
            }
            merged.push(row_indices.len());
        }
        let place = |row: u32, column: u32| {
            if row == FIXED || column == FIXED {
                return FIXED;
            }
            let from = merged[column as usize];
            let rows: &[usize] = &row_indices[from..merged[column as usize + 1]];
            rows.binary_search(&(row as usize)).map_or(FIXED, |at| (from + at) as u32)
        };
        let places = elements.iter().map(|e| e.map(|row| e.map(|column| place(row, column)))).collect();
        Ok(Self { unknowns, starts: merged, row_indices, places })
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// The matrix with these values on the diagonal, plus all element matrices, added in their order: entry `[i][j]` of an
    /// element's matrix is added in the row of its unknown i and the column of its unknown j.
    ///
    /// # Errors
    /// [`SolveError::Length`] if the diagonal has another length; [`SolveError::NonFinite`].
    pub fn assemble(
        &self,
        diagonal: &[f64],
        element: impl Fn(usize) -> [[f64; K]; K],
    ) -> Result<SparseMatrix, SolveError> {
        let (found, expected) = (diagonal.len(), self.unknowns);
        if found != expected {
            return Err(SolveError::Length { what: "values on the diagonal", found, expected });
        }
        let mut values = vec![0.0; self.row_indices.len()];
        for (column, &value) in diagonal.iter().enumerate() {
            let rows = &self.row_indices[self.starts[column]..self.starts[column + 1]];
            values[self.starts[column] + rows.partition_point(|row| *row < column)] = value;
        }
        for (m, places) in self.places.iter().enumerate() {
            let entries = element(m);
            for (place, entry) in places.iter().flatten().zip(entries.iter().flatten()) {
                if *place != FIXED {
                    values[*place as usize] += entry;
                }
            }
        }
        SparseMatrix::from_parts(self.unknowns, self.starts.clone(), self.row_indices.clone(), values)
    }
}

impl ElementPattern<3> {
    /// The pattern with each unknown i replaced by the two unknowns 2 i and 2 i + 1. Equal to [`new`](Self::new) for the doubled
    /// unknowns, without sorting again.
    ///
    /// # Cost
    /// O(m).
    pub fn doubled(&self) -> ElementPattern<6> {
        let mut starts = Vec::with_capacity(2 * self.unknowns + 1);
        let mut row_indices = Vec::with_capacity(4 * self.row_indices.len());
        starts.push(0);
        let mut columns = vec![0_u32; self.row_indices.len()];
        for column in 0..self.unknowns {
            let range = self.starts[column]..self.starts[column + 1];
            columns[range.clone()].fill(column as u32);
            for _ in 0..2 {
                row_indices
                    .extend(self.row_indices[range.clone()].iter().flat_map(|&row| [2 * row, 2 * row + 1]));
                starts.push(row_indices.len());
            }
        }
        let place = |place: u32, row: usize, column: usize| {
            if place == FIXED {
                return FIXED;
            }
            let of = columns[place as usize] as usize;
            let (from, to) = (self.starts[of], self.starts[of + 1]);
            (4 * from + 2 * (to - from) * column + 2 * (place as usize - from) + row) as u32
        };
        let places = self
            .places
            .iter()
            .map(|places| {
                let mut doubled = [[FIXED; 6]; 6];
                for (i, row) in doubled.iter_mut().enumerate() {
                    for (j, entry) in row.iter_mut().enumerate() {
                        *entry = place(places[i / 2][j / 2], i % 2, j % 2);
                    }
                }
                doubled
            })
            .collect();
        ElementPattern { unknowns: 2 * self.unknowns, starts, row_indices, places }
    }
}
