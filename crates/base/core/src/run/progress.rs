//! How far a computation has come, for those who wait.

use std::ops::ControlFlow;

/// How far a computation has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'p> {
    /// What is being done, in a few words without a full stop.
    pub doing: &'p str,
    /// The share that is done, between 0 and 1; none where it cannot be told.
    pub share: Option<f64>,
}

/// Watches a computation.
///
/// A closure that takes a [`Progress`] is one. Systems whose intermediate results are worth watching have observers of
/// their own.
pub trait ProgressObserver: Send + Sync {
    /// Called at regular intervals, by one thread at a time; [`ControlFlow::Break`] cancels the computation.
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()>;
}

impl<F: Fn(&Progress<'_>) -> ControlFlow<()> + Send + Sync> ProgressObserver for F {
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()> {
        self(progress)
    }
}

/// Watches nothing.
impl ProgressObserver for () {
    fn progress(&self, _: &Progress<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
