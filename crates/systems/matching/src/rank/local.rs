//! Ranking on this machine.

use super::driver::Ranking;
use super::options::{RankError, RankOptions};
use super::report::Report;
use super::task::{Outcome, Task, perform};
use super::template::Template;
use crate::tasks::{Watch, bytes_of, holding};
use pompeiu_core::TriMesh;
use pompeiu_core::run::on_threads;
use pompeiu_hausdorff::HausdorffOptions;
use rayon::prelude::*;

/// Runs a ranking to its end, or until a limit or the observer of the options ends it; the report then lists the open targets.
///
/// `done` runs a task; it may read a mesh or a journal to do so. It receives the limits of its searches and passes them to
/// [`perform`], after subtracting the memory that it holds itself. `after` is called after every round.
///
/// # Errors
/// Those of [`RankOptions::check`]; [`RankError::Answer`] if `done` returns results that do not match.
pub fn run(
    ranking: &mut Ranking,
    options: &RankOptions<'_>,
    done: impl Fn(&Task, &HausdorffOptions<'_>) -> Outcome + Sync,
    mut after: impl FnMut(&Ranking) + Send,
) -> Result<(), RankError> {
    options.check()?;
    on_threads(options.limits.threads, || {
        let watch = Watch::start(&options.limits, options.observer);
        while !ranking.round().is_empty() {
            let (tasks, settled, meshes) = (ranking.round().len(), ranking.settled(), ranking.targets());
            watch.tell(|p| (p.done, p.tasks, p.settled, p.meshes) = (0, tasks, settled, meshes));
            let done = |task: &Task| {
                if watch.is_stopped() {
                    return None;
                }
                let outcome = done(task, &watch.search());
                watch.tell(|progress| progress.done += 1);
                Some(outcome)
            };
            let mut outcomes = Vec::with_capacity(tasks);
            for tasks in ranking.round().chunks(watch.at_a_time()) {
                outcomes.par_extend(tasks.par_iter().map(&done));
            }
            ranking.merge_done(outcomes, || watch.reason())?;
            after(ranking);
        }
        Ok(())
    })
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
    let digits = targets.len().to_string().len();
    let names = (0..targets.len()).map(|i| format!("{i:0digits$}")).collect();
    let mut ranking = Ranking::new(names, options)?;
    let template = on_threads(options.limits.threads, || Template::new(template.clone(), options))?;
    let held: usize = targets.iter().map(bytes_of).sum();
    let done = |task: &Task, search: &HausdorffOptions<'_>| {
        let target = &targets[task.target];
        let mut search = search.clone();
        holding(&mut search, held - bytes_of(target));
        perform(&template, target, &task.action, &search)
    };
    run(&mut ranking, options, done, |_| ())?;
    Ok(ranking.report())
}
