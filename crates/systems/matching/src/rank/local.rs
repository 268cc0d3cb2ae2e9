//! Ranking on this machine.

use super::driver::Ranking;
use super::options::{RankError, RankOptions};
use super::report::Report;
use super::task::{Outcome, Task, perform};
use super::template::Template;
use crate::meshes::Meshes;
use crate::tasks::{Watch, holding};
use pompeiu_core::TriMesh;
use pompeiu_core::run::on_threads;
use pompeiu_hausdorff::HausdorffOptions;
use rayon::prelude::*;
use std::borrow::Borrow;

/// Ranks meshes by their distance from a template until that is done, or a limit or the observer of the options ends it; the report
/// then lists the open targets. Meshes that cannot be used have failed.
///
/// # Errors
/// [`RankError`] if the options or the template cannot be used, or there are no targets.
pub fn rank<M: Meshes>(
    template: &TriMesh,
    meshes: &M,
    options: &RankOptions<'_>,
) -> Result<Report, RankError> {
    let names = (0..meshes.count()).map(|index| meshes.name(index)).collect();
    let mut ranking = Ranking::new(names, options)?;
    on_threads(options.limits.threads, || {
        let template = Template::new(template.clone(), options)?;
        let watch = Watch::start(&options.limits, options.observer);
        while !ranking.round().is_empty() {
            round(&mut ranking, &template, meshes, &watch)?;
            meshes.keep_only(&|target| ranking.wants(target));
        }
        Ok(ranking.report())
    })
}

/// Does the tasks of a round.
fn round<M: Meshes>(
    ranking: &mut Ranking,
    template: &Template,
    meshes: &M,
    watch: &Watch<'_>,
) -> Result<(), RankError> {
    let (tasks, settled, all) = (ranking.round().len(), ranking.settled(), ranking.targets());
    watch.tell(|p| (p.done, p.tasks, p.settled, p.meshes) = (0, tasks, settled, all));
    let done = |task: &Task| {
        if watch.is_stopped() {
            return None;
        }
        let outcome = outcome(template, meshes, task, watch.search());
        watch.tell(|progress| progress.done += 1);
        Some(outcome)
    };
    let mut outcomes = Vec::with_capacity(tasks);
    for tasks in ranking.round().chunks(watch.at_a_time()) {
        outcomes.par_extend(tasks.par_iter().map(&done));
    }
    ranking.merge_done(outcomes, || watch.reason())
}

/// What comes of a task: known, or found now.
fn outcome<M: Meshes>(
    template: &Template,
    meshes: &M,
    task: &Task,
    mut search: HausdorffOptions<'_>,
) -> Outcome {
    // Results of tasks depend on the number of places only through the requests of the tasks.
    let question = ("rank", template.measure, template.alignment, &task.action);
    if let Some(known) = meshes.known(&question, &[task.target]) {
        return known;
    }
    let outcome = match meshes.mesh(task.target) {
        Ok(mesh) => {
            holding(&mut search, meshes.bytes_beside(task.target));
            perform(template, mesh.borrow(), &task.action, &search)
        }
        Err(message) => Outcome::Failed(message),
    };
    if outcome.is_complete() {
        meshes.found(&question, &[task.target], &outcome);
    }
    outcome
}

/// Ranks meshes in memory, named by their indices.
///
/// # Errors
/// [`RankError`] if the options or the template cannot be used. Targets that cannot be aligned are reported as failed.
pub fn rank_meshes(
    template: &TriMesh,
    targets: &[TriMesh],
    options: &RankOptions<'_>,
) -> Result<Report, RankError> {
    let targets: Vec<&TriMesh> = targets.iter().collect();
    rank(template, &targets.as_slice(), options)
}
