//! What a computation runs with: its limits, counted from one start, and who watches it.

use super::{Control, Instant, Limits, Progress, ProgressObserver, StopReason, on_threads};
use std::ops::ControlFlow;

/// What a computation runs with: threads, time, memory, cancelling and progress.
///
/// Whoever starts a computation makes one, and hands it to everything that belongs to it: reading, several systems, pages. The time
/// limit counts from [`RunContext::start`], so a part that starts late has less of it. A computation that takes a context obeys each of
/// its limits that [`Request::LIMITS`](crate::request::Request::LIMITS) names.
///
/// # Example
/// ```
/// use pompeiu_core::run::{Limits, RunContext, StopReason};
/// use std::time::Duration;
///
/// let context = RunContext::start(Limits { time: Some(Duration::ZERO), ..Limits::default() });
/// let control = context.control();
/// assert!(control.is_stopped());
/// assert_eq!(control.reason(), Some(StopReason::Time));
/// ```
#[derive(Clone, Default)]
pub struct RunContext<'r> {
    limits: Limits,
    deadline: Option<Instant>,
    progress: Option<&'r dyn ProgressObserver>,
}

impl<'r> RunContext<'r> {
    /// Limits whose time starts now.
    pub fn start(limits: Limits) -> Self {
        Self { deadline: limits.deadline(), limits, progress: None }
    }

    /// The same with an observer of the progress.
    #[must_use]
    pub fn watched_by(self, progress: &'r dyn ProgressObserver) -> Self {
        Self { progress: Some(progress), ..self }
    }

    /// The limits for a part that starts now: the time is what is left of it.
    pub fn limits(&self) -> Limits {
        let left = |deadline: Instant| deadline.saturating_duration_since(Instant::now());
        Limits { time: self.deadline.map(left).or(self.limits.time), ..self.limits.clone() }
    }

    /// The control of a part that starts now.
    pub fn control(&self) -> Control {
        Control::start(&self.limits).until(self.deadline)
    }

    /// Who watches.
    pub fn progress(&self) -> Option<&'r dyn ProgressObserver> {
        self.progress
    }

    /// Takes steps in time from number `done` until `asked` are done, and reports the progress of each. It ends early if `watch`, which
    /// sees the state before the first step and after each one, or the observer of the progress breaks, or a limit of `control` acts.
    ///
    /// # Errors
    /// That of the first step that fails; the state is that after the step before.
    pub fn take_steps<S, E>(
        &self,
        control: &Control,
        state: &mut S,
        [done, asked]: [usize; 2],
        mut watch: impl FnMut(&S) -> ControlFlow<()>,
        mut step: impl FnMut(&mut S) -> Result<(), E>,
    ) -> Result<(), E> {
        for done in done.. {
            if watch(state).is_break() {
                control.stop(StopReason::Cancelled);
            }
            if done == asked {
                break;
            }
            let progress = Progress { doing: "simulating", share: Some(done as f64 / asked.max(1) as f64) };
            if self.progress.is_some_and(|observer| observer.progress(&progress).is_break()) {
                control.stop(StopReason::Cancelled);
            }
            if control.is_stopped() {
                break;
            }
            step(state)?;
        }
        Ok(())
    }

    /// Does work on the threads that the limits allow.
    pub fn on_threads<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        on_threads(self.limits.threads, work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_part_that_starts_late_has_less_time() {
        let context = RunContext::start(Limits { time: Some(Duration::from_hours(1)), ..Limits::default() });
        let first = context.limits().time.unwrap();
        std::thread::sleep(Duration::from_millis(1));
        let second = context.limits().time.unwrap();
        assert!(second + Duration::from_millis(1) <= first, "{first:?} {second:?}");
        assert!(!context.control().is_stopped());
        assert_eq!(RunContext::default().limits(), Limits::default());
    }
}
