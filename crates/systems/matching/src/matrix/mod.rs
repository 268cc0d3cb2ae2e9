//! Distances between all pairs of some meshes.
//!
//! A **task** is one directed distance, a pure function of two meshes ([`directed`]) with a plain result. [`tasks`] lists them all,
//! grouped by the mesh that is measured to, so that its tree is built once. [`Matrix`] collects the results, in any order.
//! [`measure`] runs all tasks on this machine until they are done or a limit of [`MatrixOptions`] or its observer ends it; unknown
//! distances are then [open](Matrix::open).
//!
//! # Example
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_matching::matrix::{MatrixOptions, matrix_of};
//!
//! let matrix = matrix_of(&[icosphere(1.0, 1)?, icosphere(1.5, 1)?], &MatrixOptions::default())?;
//! let [lower, upper] = matrix.symmetric(0, 1).unwrap();
//! assert!(lower <= 0.5 && 0.5 <= upper);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod local;
mod options;

pub use local::{matrix_of, measure};
pub use options::MatrixOptions;

use pompeiu_core::TriMesh;
use pompeiu_core::run::StopReason;
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, OptionError, Target};
use serde::{Deserialize, Serialize};

/// One directed distance from a mesh to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Task {
    /// The index of the mesh that is measured.
    pub from: usize,
    /// The index of the mesh that it is measured to.
    pub to: usize,
}

/// The tasks for `count` meshes, grouped by `to`.
pub fn tasks(count: usize) -> impl Iterator<Item = Task> {
    (0..count)
        .flat_map(move |to| (0..count).filter(move |from| *from != to).map(move |from| Task { from, to }))
}

/// Encloses a directed distance.
///
/// # Errors
/// Those of [`MatrixOptions::check`].
pub fn directed(
    from: &TriMesh,
    to: &Target,
    options: &MatrixOptions<'_>,
) -> Result<DirectedReport, OptionError> {
    let limits = options.limits.clone();
    HausdorffOptions { tolerance: options.tolerance, limits, ..HausdorffOptions::default() }
        .directed_to(from, to)
}

/// The part of a directed report that a matrix keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    lower: f64,
    upper: f64,
    stop: StopReason,
    /// Point–triangle distances evaluated.
    distances: u64,
}

/// The directed distances between some meshes, as far as they are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    count: usize,
    /// Row by row: row i holds the distances from mesh i.
    entries: Vec<Option<Entry>>,
    /// Why pairs were not measured.
    stopped: Option<StopReason>,
}

impl Matrix {
    /// A matrix in which only the zero diagonal is known.
    pub fn new(count: usize) -> Self {
        let itself = Entry { lower: 0.0, upper: 0.0, stop: StopReason::Tolerance, distances: 0 };
        let entry = |at| (count > 0 && at / count == at % count).then_some(itself);
        Self { count, entries: (0..count * count).map(entry).collect(), stopped: None }
    }

    /// Number of meshes.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Records a result.
    ///
    /// # Panics
    /// If the task names a mesh that does not exist.
    pub fn set(&mut self, task: Task, report: &DirectedReport) {
        assert!(task.from < self.count && task.to < self.count, "{task:?} in a matrix of {}", self.count);
        let [lower, upper] = [report.distance.lower(), report.distance.upper()];
        let entry = Entry { lower, upper, stop: report.stop, distances: report.work.distances };
        self.entries[task.from * self.count + task.to] = Some(entry);
    }

    /// Records why the unknown pairs were not measured; the first reason stays.
    pub fn stop(&mut self, reason: StopReason) {
        self.stopped.get_or_insert(reason);
    }

    fn entry(&self, i: usize, j: usize) -> Option<&Entry> {
        (i < self.count && j < self.count).then(|| self.entries[i * self.count + j].as_ref()).flatten()
    }

    /// Encloses the directed distance from mesh i to mesh j, if it is known.
    pub fn directed(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        self.entry(i, j).map(|entry| [entry.lower, entry.upper])
    }

    /// Encloses the symmetric distance of mesh i and mesh j, if it is known; symmetric in i and j.
    pub fn symmetric(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        let (one, other) = (self.directed(i, j)?, self.directed(j, i)?);
        Some([0, 1].map(|end| if one[end] > other[end] { one[end] } else { other[end] }))
    }

    /// Why the computation ended: [`StopReason::Tolerance`] unless a limit or the observer left pairs open.
    pub fn stop_reason(&self) -> StopReason {
        let of_pair = || self.entries.iter().flatten().map(|entry| entry.stop).find(|stop| stop.is_early());
        self.stopped.or_else(of_pair).unwrap_or(StopReason::Tolerance)
    }

    /// The distances that are unknown, or whose enclosures are wider than asked because their search was stopped.
    pub fn open(&self) -> impl Iterator<Item = Task> {
        tasks(self.count)
            .filter(|task| self.entry(task.from, task.to).is_none_or(|entry| entry.stop.is_early()))
    }

    /// Point–triangle distances evaluated.
    pub fn distances(&self) -> u64 {
        self.entries.iter().flatten().map(|entry| entry.distances).sum()
    }
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
        use pompeiu_core::mesh::shapes::icosphere;
        let report = |from, to| {
            let target = Target::new(&icosphere(to, 1).unwrap());
            directed(&icosphere(from, 1).unwrap(), &target, &MatrixOptions::default()).unwrap()
        };
        let [there, back] = [report(1.0, 1.5), report(1.5, 1.0)];
        let ends = |report: &DirectedReport| [report.distance.lower(), report.distance.upper()];
        let mut matrix = Matrix::new(2);
        assert_eq!((matrix.symmetric(1, 1), matrix.open().count()), (Some([0.0, 0.0]), 2));
        matrix.set(Task { from: 0, to: 1 }, &there);
        assert_eq!((matrix.directed(0, 1), matrix.symmetric(0, 1)), (Some(ends(&there)), None));
        assert_eq!(matrix.open().collect::<Vec<_>>(), [Task { from: 1, to: 0 }]);
        matrix.set(Task { from: 1, to: 0 }, &back);
        let greater = [0, 1].map(|end| f64::max(ends(&there)[end], ends(&back)[end]));
        assert_eq!((matrix.symmetric(0, 1), matrix.symmetric(1, 0)), (Some(greater), Some(greater)));
        let distances = there.work.distances + back.work.distances;
        assert_eq!((matrix.directed(0, 2), matrix.distances()), (None, distances));
        assert_eq!((matrix.open().count(), matrix.stop_reason()), (0, StopReason::Tolerance));
        matrix.set(Task { from: 1, to: 0 }, &DirectedReport { stop: StopReason::Memory, ..back });
        assert_eq!((matrix.open().count(), matrix.stop_reason()), (1, StopReason::Memory));
    }
}
