//! Distances between all pairs of some meshes.
//!
//! A **task** is one directed distance, a pure function of two meshes ([`directed`]) with a plain result; [`tasks`] names them all,
//! grouped by the mesh that is measured to, whose tree is then built once. [`Matrix`] gathers the results, in any order.
//!
//! # Example
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_matching::matrix::matrix_of;
//!
//! let matrix = matrix_of(&[icosphere(1.0, 1)?, icosphere(1.5, 1)?], 1e-9)?;
//! let [lower, upper] = matrix.symmetric(0, 1).unwrap();
//! assert!(lower <= 0.5 && 0.5 <= upper);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use pompeiu_core::TriMesh;
use pompeiu_hausdorff::{HausdorffOptions, OptionError, Target, Tolerance};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// One directed distance: how far the points of a mesh are from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// The mesh that is measured, by its place.
    pub from: usize,
    /// The mesh that it is measured to, by its place.
    pub to: usize,
}

/// The tasks for `count` meshes, all to the same mesh together.
pub fn tasks(count: usize) -> impl Iterator<Item = Task> {
    (0..count)
        .flat_map(move |to| (0..count).filter(move |from| *from != to).map(move |from| Task { from, to }))
}

/// The enclosure of a directed distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Proven lower bound.
    pub lower: f64,
    /// Proven upper bound.
    pub upper: f64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
}

/// Encloses a directed distance to a tolerance that is a fraction of the diagonal of the joint box.
///
/// # Errors
/// [`OptionError::Tolerance`] unless it is finite and not negative.
pub fn directed(from: &TriMesh, to: &Target, tolerance: f64) -> Result<Entry, OptionError> {
    let tolerance = Tolerance::RelativeToDiagonal(tolerance);
    let report = HausdorffOptions { tolerance, ..HausdorffOptions::default() }.directed_to(from, to)?;
    let [lower, upper] = [report.distance.lower(), report.distance.upper()];
    Ok(Entry { lower, upper, distances: report.work.distances })
}

/// The directed distances between some meshes, as far as they are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Matrix {
    count: usize,
    /// Row by row: row i holds the distances from mesh i.
    entries: Vec<Option<Entry>>,
}

impl Matrix {
    /// Nothing is known but that every mesh is at no distance from itself.
    pub fn new(count: usize) -> Self {
        let entry = |at| {
            let itself = count > 0 && at / count == at % count;
            itself.then_some(Entry { lower: 0.0, upper: 0.0, distances: 0 })
        };
        Self { count, entries: (0..count * count).map(entry).collect() }
    }

    /// Number of meshes.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Notes a result.
    ///
    /// # Panics
    /// If the task names a mesh that is not there.
    pub fn set(&mut self, task: Task, entry: Entry) {
        assert!(task.from < self.count && task.to < self.count, "{task:?} in a matrix of {}", self.count);
        self.entries[task.from * self.count + task.to] = Some(entry);
    }

    /// Encloses the directed distance from mesh i to mesh j, if it is known.
    pub fn directed(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        let entry = (i < self.count && j < self.count).then(|| self.entries[i * self.count + j]).flatten()?;
        Some([entry.lower, entry.upper])
    }

    /// Encloses the symmetric distance of mesh i and mesh j, if it is known: the same both ways.
    pub fn symmetric(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        let (one, other) = (self.directed(i, j)?, self.directed(j, i)?);
        Some([0, 1].map(|end| if one[end] > other[end] { one[end] } else { other[end] }))
    }

    /// Point–triangle distances evaluated.
    pub fn distances(&self) -> u64 {
        self.entries.iter().flatten().map(|entry| entry.distances).sum()
    }
}

/// The matrix of meshes in memory, on the threads of the current pool; the same bits for any number of them.
///
/// # Errors
/// [`OptionError::Tolerance`] unless it is finite and not negative.
///
/// # Cost
/// One tree and n − 1 searches for each of n meshes.
pub fn matrix_of(meshes: &[TriMesh], tolerance: f64) -> Result<Matrix, OptionError> {
    let mut matrix = Matrix::new(meshes.len());
    for (to, mesh) in meshes.iter().enumerate() {
        let target = Target::new(mesh);
        let row: Vec<_> = meshes
            .par_iter()
            .enumerate()
            .filter(|(from, _)| *from != to)
            .map(|(from, mesh)| directed(mesh, &target, tolerance).map(|entry| (Task { from, to }, entry)))
            .collect::<Result<_, _>>()?;
        for (task, entry) in row {
            matrix.set(task, entry);
        }
    }
    Ok(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_all_pairs_grouped_by_where_they_lead() {
        let all: Vec<Task> = tasks(4).collect();
        assert_eq!(all.len(), 12);
        assert!(all.windows(2).all(|w| (w[0].to, w[0].from) < (w[1].to, w[1].from)));
        assert!(all.iter().all(|task| task.from != task.to));
        assert_eq!((tasks(0).count(), tasks(1).count()), (0, 0));
    }

    #[test]
    fn what_is_not_known_is_none() {
        let mut matrix = Matrix::new(2);
        assert_eq!(matrix.symmetric(1, 1), Some([0.0, 0.0]));
        matrix.set(Task { from: 0, to: 1 }, Entry { lower: 1.0, upper: 2.0, distances: 7 });
        assert_eq!((matrix.directed(0, 1), matrix.symmetric(0, 1)), (Some([1.0, 2.0]), None));
        matrix.set(Task { from: 1, to: 0 }, Entry { lower: 0.5, upper: 3.0, distances: 7 });
        assert_eq!((matrix.symmetric(0, 1), matrix.symmetric(1, 0)), (Some([1.0, 3.0]), Some([1.0, 3.0])));
        assert_eq!((matrix.directed(0, 2), matrix.distances()), (None, 14));
    }
}
