//! Progress reports of running computations.

use std::ops::ControlFlow;

/// Progress of a computation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'p> {
    /// The current activity, in a few words without a full stop.
    pub doing: &'p str,
    /// The share that is done, between 0 and 1; `None` where it is unknown.
    pub share: Option<f64>,
}

/// Receives the progress of a computation.
///
/// Closures that take a [`Progress`] implement it. Systems with intermediate results have observers of their own.
pub trait ProgressObserver: Send + Sync {
    /// Called at regular intervals, by one thread at a time; [`ControlFlow::Break`] cancels the computation.
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()>;

    /// Whether somebody reads [`Progress::doing`]. What is computed for it alone is left out otherwise.
    fn reads_doing(&self) -> bool {
        true
    }
}

impl<F: Fn(&Progress<'_>) -> ControlFlow<()> + Send + Sync> ProgressObserver for F {
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()> {
        self(progress)
    }
}

/// Ignores progress.
impl ProgressObserver for () {
    fn progress(&self, _: &Progress<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn reads_doing(&self) -> bool {
        false
    }
}
