//! All pairs on this machine.

use super::{Matrix, MatrixOptions, Task};
use crate::tasks::{MeasuredTo, Watch, bytes_of, holding};
use pompeiu_core::TriMesh;
use pompeiu_core::run::on_threads;
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, OptionError, Tolerance};
use rayon::prelude::*;
use std::borrow::Borrow;

/// The meshes of a matrix, wherever they are.
pub trait Meshes: Sync {
    /// A mesh, for as long as it is looked at.
    type Mesh: Borrow<TriMesh> + Sync;

    /// How many there are.
    fn count(&self) -> usize;

    /// The mesh at a place; none if it cannot be used.
    fn mesh(&self, index: usize) -> Option<Self::Mesh>;

    /// Bytes of memory that meshes take while none is looked at.
    fn bytes(&self) -> usize;

    /// A result that is known already.
    fn known(&self, task: Task) -> Option<DirectedReport> {
        let _ = task;
        None
    }

    /// Called with each result that was found as asked, by any thread.
    fn found(&self, task: Task, report: &DirectedReport) {
        let _ = (task, report);
    }
}

/// Meshes in memory.
impl<'m> Meshes for &[&'m TriMesh] {
    type Mesh = &'m TriMesh;

    fn count(&self) -> usize {
        self.len()
    }

    fn mesh(&self, index: usize) -> Option<&'m TriMesh> {
        self.get(index).copied()
    }

    fn bytes(&self) -> usize {
        self.iter().map(|mesh| bytes_of(mesh)).sum()
    }
}

/// The matrix of meshes in memory; the same bits for any number of threads, unless the clock or the observer ends it.
///
/// # Errors
/// Those of [`MatrixOptions::check`].
///
/// # Cost
/// One tree and n − 1 searches for each of n meshes.
pub fn matrix_of(meshes: &[TriMesh], options: &MatrixOptions<'_>) -> Result<Matrix, OptionError> {
    let meshes: Vec<&TriMesh> = meshes.iter().collect();
    measure(&meshes.as_slice(), options)
}

/// The matrix of meshes wherever they are. A pair with a mesh that cannot be used is not known in it.
///
/// # Errors
/// Those of [`MatrixOptions::check`].
pub fn measure<M: Meshes>(meshes: &M, options: &MatrixOptions<'_>) -> Result<Matrix, OptionError> {
    options.check()?;
    on_threads(options.limits.threads, || {
        let watch = Watch::start(&options.limits, options.observer);
        let count = meshes.count();
        watch.tell(|p| (p.tasks, p.meshes) = (count * count.saturating_sub(1), count));
        let mut matrix = Matrix::new(count);
        for to in 0..count {
            column(meshes, options.tolerance, &watch, &mut matrix, to)?;
            watch.tell(|progress| progress.settled += 1);
        }
        Ok(matrix)
    })
}

/// All distances to one mesh: its tree is built once, and only if something is measured.
fn column<M: Meshes>(
    meshes: &M,
    tolerance: Tolerance,
    watch: &Watch<'_>,
    matrix: &mut Matrix,
    to: usize,
) -> Result<(), OptionError> {
    let mut left = Vec::new();
    for task in (0..meshes.count()).filter(|from| *from != to).map(|from| Task { from, to }) {
        match meshes.known(task) {
            Some(report) => {
                matrix.set(task, &report);
                watch.tell(|progress| progress.done += 1);
            }
            None => left.push(task),
        }
    }
    // A single mesh is looked at too, so that what is wrong with it is told.
    if left.is_empty() && meshes.count() > 1 {
        return Ok(());
    }
    if watch.is_stopped() {
        matrix.stop(watch.reason());
        return Ok(());
    }
    let Some(mesh) = meshes.mesh(to) else {
        watch.tell(|progress| progress.done += left.len());
        return Ok(());
    };
    let mesh: &TriMesh = mesh.borrow();
    let with_limits = || {
        let mut search = HausdorffOptions { tolerance, ..watch.search() };
        // A search counts the mesh that is measured, whether or not it is one of those that are kept.
        holding(&mut search, meshes.bytes().saturating_add(bytes_of(mesh)));
        search
    };
    let target = MeasuredTo::new(mesh, with_limits().limits.memory);
    let search = |task: &Task| -> Result<Option<DirectedReport>, OptionError> {
        let report = meshes.mesh(task.from).map(|from| {
            let from: &TriMesh = from.borrow();
            target.directed(from, &with_limits())
        });
        let report = report.transpose()?;
        if let Some(report) = report.as_ref().filter(|report| !report.stop.is_early()) {
            meshes.found(*task, report);
        }
        watch.tell(|progress| progress.done += 1);
        Ok(report)
    };
    for tasks in left.chunks(watch.at_a_time()) {
        if watch.is_stopped() {
            matrix.stop(watch.reason());
            break;
        }
        let reports = tasks.par_iter().map(search).collect::<Result<Vec<_>, _>>()?;
        for (task, report) in tasks.iter().zip(reports) {
            if let Some(report) = report {
                matrix.set(*task, &report);
            }
        }
    }
    Ok(())
}
