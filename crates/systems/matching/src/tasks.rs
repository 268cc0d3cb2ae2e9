//! Running many tasks on this machine: limits, cancelling and progress.

use pompeiu_core::TriMesh;
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, Limits, StopReason};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, Observer, OptionError, Progress, Target};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Progress of many tasks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TaskProgress {
    /// Tasks done: of the round of a ranking, or pairs of a matrix.
    pub done: usize,
    /// Tasks in all: of the round of a ranking, or pairs of a matrix.
    pub tasks: usize,
    /// Targets of a ranking, or columns of a matrix, that are settled.
    pub settled: usize,
    /// Targets of a ranking, or columns of a matrix.
    pub meshes: usize,
}

/// Receives the progress of a ranking or a matrix. Closures that take a [`TaskProgress`] implement it.
pub trait TaskObserver: Send + Sync {
    /// Called after every task and several times a second during long searches, by one thread at a time. [`ControlFlow::Break`]
    /// ends the computation with the bounds proven so far.
    fn progress(&self, progress: &TaskProgress) -> ControlFlow<()>;
}

impl<F: Fn(&TaskProgress) -> ControlFlow<()> + Send + Sync> TaskObserver for F {
    fn progress(&self, progress: &TaskProgress) -> ControlFlow<()> {
        self(progress)
    }
}

impl fmt::Debug for dyn TaskObserver + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TaskObserver")
    }
}

/// Tasks in progress per thread: their meshes are in memory together. More than one keeps all threads busy when tasks differ in
/// size.
const TASKS_PER_THREAD: usize = 2;

/// The limits of running tasks, and their progress.
pub(crate) struct Watch<'o> {
    limits: &'o Limits,
    deadline: Option<Instant>,
    control: Control,
    observer: Option<&'o dyn TaskObserver>,
    progress: Mutex<TaskProgress>,
}

impl<'o> Watch<'o> {
    /// Watches tasks that start now.
    pub(crate) fn start(limits: &'o Limits, observer: Option<&'o dyn TaskObserver>) -> Self {
        let deadline = limits.deadline();
        let control = Control::start(limits).until(deadline);
        Self { limits, deadline, control, observer, progress: Mutex::default() }
    }

    /// How many tasks run at the same time. With a memory limit, each uses the remaining memory alone, so that results do not
    /// depend on the number of threads.
    pub(crate) fn at_a_time(&self) -> usize {
        if self.limits.memory.is_some() { 1 } else { TASKS_PER_THREAD * rayon::current_num_threads() }
    }

    /// The limits and observer for a search that starts now; tolerance and threshold still have to be set.
    pub(crate) fn search(&self) -> HausdorffOptions<'_> {
        let time = self.deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()));
        let limits = Limits { time, threads: None, ..self.limits.clone() };
        HausdorffOptions { limits, observer: Some(self), ..HausdorffOptions::default() }
    }

    /// Whether to start no further task.
    pub(crate) fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// Why tasks were not done.
    pub(crate) fn reason(&self) -> StopReason {
        self.control.reason().unwrap_or(StopReason::Cancelled)
    }

    /// Updates the progress and reports it.
    pub(crate) fn tell(&self, change: impl FnOnce(&mut TaskProgress)) {
        let mut progress: MutexGuard<'_, TaskProgress> =
            self.progress.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut progress);
        if self.observer.is_some_and(|observer| observer.progress(&progress).is_break()) {
            self.control.stop(StopReason::Cancelled);
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, _: &Progress) -> ControlFlow<()> {
        self.tell(|_| ());
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Bytes of the arrays of a mesh.
pub(crate) fn bytes_of(mesh: &TriMesh) -> usize {
    size_of_val(mesh.positions()) + size_of_val(mesh.faces())
}

/// Reduces the memory limit of a search by memory held elsewhere.
pub(crate) fn holding(search: &mut HausdorffOptions<'_>, bytes: usize) {
    search.limits.memory = search.limits.memory.map(|memory| memory.saturating_sub(bytes));
}

/// A mesh that others are measured to; prepared unless that would exceed the memory limit.
pub(crate) struct MeasuredTo<'m> {
    mesh: &'m TriMesh,
    target: Option<Target>,
}

impl<'m> MeasuredTo<'m> {
    pub(crate) fn new(mesh: &'m TriMesh, memory: Option<usize>) -> Self {
        let fits = memory.is_none_or(|memory| Target::bytes_to_prepare(mesh.faces().len()) <= memory);
        Self { mesh, target: fits.then(|| Target::new(mesh)) }
    }

    /// A directed distance; without a tree, it is bounded in linear time.
    pub(crate) fn directed(
        &self,
        from: &TriMesh,
        search: &HausdorffOptions<'_>,
    ) -> Result<DirectedReport, OptionError> {
        match &self.target {
            Some(target) => search.directed_to(from, target),
            None => search.directed(from, self.mesh),
        }
    }
}
