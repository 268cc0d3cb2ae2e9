//! All pairs on this machine.

use super::{Matrix, MatrixOptions, Task};
use crate::meshes::Meshes;
use crate::tasks::{MeasuredTo, Watch, bytes_of, holding};
use pompeiu_core::TriMesh;
use pompeiu_core::run::on_threads;
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, OptionError, Tolerance};
use rayon::prelude::*;
use std::borrow::Borrow;

/// The matrix of meshes in memory; the same bits for any number of threads, unless time runs out or the observer ends it.
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

/// The matrix of meshes, in memory or elsewhere. Pairs with a mesh that cannot be used stay unknown.
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

/// All distances to one mesh. Its tree is built once, and only if a distance is computed.
fn column<M: Meshes>(
    meshes: &M,
    tolerance: Tolerance,
    watch: &Watch<'_>,
    matrix: &mut Matrix,
    to: usize,
) -> Result<(), OptionError> {
    let question = ("matrix", tolerance);
    let mut left = Vec::new();
    for task in (0..meshes.count()).filter(|from| *from != to).map(|from| Task { from, to }) {
        match meshes.known(&question, &[task.from, task.to]) {
            Some(report) => {
                matrix.set(task, &report);
                watch.tell(|progress| progress.done += 1);
            }
            None => left.push(task),
        }
    }
    // A single mesh is loaded too, so that errors in it are reported.
    if left.is_empty() && meshes.count() > 1 {
        return Ok(());
    }
    if watch.is_stopped() {
        matrix.stop(watch.reason());
        return Ok(());
    }
    let Ok(mesh) = meshes.mesh(to) else {
        watch.tell(|progress| progress.done += left.len());
        return Ok(());
    };
    let mesh: &TriMesh = mesh.borrow();
    let with_limits = || {
        let mut search = HausdorffOptions { tolerance, ..watch.search() };
        // A search counts the measured mesh against the memory limit, whether or not it is one of those kept.
        holding(&mut search, meshes.bytes().saturating_add(bytes_of(mesh)));
        search
    };
    let target = MeasuredTo::new(mesh, with_limits().limits.memory);
    let search = |task: &Task| -> Result<Option<DirectedReport>, OptionError> {
        let report = meshes.mesh(task.from).ok().map(|from| {
            let from: &TriMesh = from.borrow();
            target.directed(from, &with_limits())
        });
        let report = report.transpose()?;
        if let Some(report) = report.as_ref().filter(|report| !report.stop.is_early()) {
            meshes.found(&question, &[task.from, task.to], report);
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
