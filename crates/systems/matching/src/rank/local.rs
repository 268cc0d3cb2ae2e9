//! Ranking on this machine.

use super::driver::Ranking;
use super::options::{Options, RankError};
use super::report::Report;
use super::task::{Outcome, Task, perform};
use super::template::Template;
use pompeiu_core::TriMesh;
use rayon::prelude::*;

/// Tasks for each thread that are under way at a time: their meshes are in memory together. More keep all threads busy
/// when tasks differ in size.
const TASKS_PER_THREAD: usize = 2;

/// Runs a ranking to its end on the threads of the current pool. `done` does a task, and may read a mesh or a journal for it;
/// `after` is called after every round.
///
/// # Errors
/// [`RankError::Answer`], when `done` gives results that do not fit.
pub fn run(
    ranking: &mut Ranking,
    done: impl Fn(&Task) -> Outcome + Sync,
    mut after: impl FnMut(&Ranking),
) -> Result<(), RankError> {
    while !ranking.round().is_empty() {
        let mut outcomes = Vec::with_capacity(ranking.round().len());
        for tasks in ranking.round().chunks(TASKS_PER_THREAD * rayon::current_num_threads()) {
            outcomes.par_extend(tasks.par_iter().map(&done));
        }
        ranking.merge(outcomes)?;
        after(ranking);
    }
    Ok(())
}

/// Ranks meshes in memory, on the threads of the current pool. They are named by their places.
///
/// # Errors
/// [`RankError`], when the options or the template cannot be used. A target that cannot be aligned has failed in the report.
pub fn rank_meshes(template: &TriMesh, targets: &[TriMesh], options: &Options) -> Result<Report, RankError> {
    let digits = targets.len().to_string().len();
    let names = (0..targets.len()).map(|i| format!("{i:0digits$}")).collect();
    let mut ranking = Ranking::new(names, options)?;
    let template = Template::new(template.clone(), options)?;
    run(&mut ranking, |task| perform(&template, &targets[task.target], &task.action), |_| ())?;
    Ok(ranking.report())
}
