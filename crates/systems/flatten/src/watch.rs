//! Progress and cancellation of a computation.

use pompeiu_core::run::{Control, Progress, ProgressObserver, StopReason};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Progress of a computation over several components.
pub(crate) struct Watch<'w> {
    control: &'w Control,
    observer: Option<Mutex<&'w dyn ProgressObserver>>,
    components: usize,
    done: AtomicUsize,
}

impl<'w> Watch<'w> {
    pub(crate) fn new(
        control: &'w Control,
        observer: Option<&'w dyn ProgressObserver>,
        components: usize,
    ) -> Self {
        Self { control, observer: observer.map(Mutex::new), components, done: AtomicUsize::new(0) }
    }

    /// Counts a component that is done.
    pub(crate) fn finish_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Reports progress, and returns whether to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        if let Some(observer) = &self.observer {
            let share = self.done.load(Ordering::Relaxed) as f64 / self.components as f64;
            let progress = Progress { doing: "flattening", share: (self.components > 1).then_some(share) };
            let observer = observer.lock().unwrap_or_else(PoisonError::into_inner);
            if observer.progress(&progress).is_break() {
                self.control.stop(StopReason::Cancelled);
            }
        }
        self.control.is_stopped()
    }
}
