//! Running many tasks on this machine: limits, cancelling and progress.

use pompeiu_core::TriMesh;
use pompeiu_core::run::{Control, Limits, StopReason};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, Observer, OptionError, Progress, Target};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// How far many tasks have come.
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

/// Watches a ranking or a matrix. A closure that takes a [`TaskProgress`] is one.
pub trait TaskObserver: Send + Sync {
    /// Called after every task and several times a second during long searches, by one thread at a time;
    /// [`ControlFlow::Break`] ends the computation with what is proven.
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

/// Tasks for each thread that are under way at a time: their meshes are in memory together. More keep all threads busy
/// when tasks differ in size.
const TASKS_PER_THREAD: usize = 2;

/// The limits of tasks that are under way, and how far these have come.
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

    /// How many tasks are begun together. With a memory limit each has what is left of it to itself, so that results do not
    /// depend on the number of threads.
    pub(crate) fn at_a_time(&self) -> usize {
        if self.limits.memory.is_some() { 1 } else { TASKS_PER_THREAD * rayon::current_num_threads() }
    }

    /// What a search may take from now on: its limits and its observer. Tolerance and threshold are still to be set.
    pub(crate) fn search(&self) -> HausdorffOptions<'_> {
        let time = self.deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()));
        let limits = Limits { time, threads: None, ..self.limits.clone() };
        HausdorffOptions { limits, observer: Some(self), ..HausdorffOptions::default() }
    }

    /// Whether to begin no further task.
    pub(crate) fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// Why tasks were left undone.
    pub(crate) fn reason(&self) -> StopReason {
        self.control.reason().unwrap_or(StopReason::Cancelled)
    }

    /// Changes what is known of the progress, and tells it.
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

/// Makes less memory available: what is held beside a search.
pub(crate) fn holding(search: &mut HausdorffOptions<'_>, bytes: usize) {
    search.limits.memory = search.limits.memory.map(|memory| memory.saturating_sub(bytes));
}

/// A mesh that others are measured to, prepared unless that would exceed the memory limit.
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
