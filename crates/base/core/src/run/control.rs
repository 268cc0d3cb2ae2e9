//! When to stop before the end.

use super::{CancelToken, Instant, Limits, StopReason};
use std::sync::atomic::{AtomicU8, Ordering};

/// The limits of a running computation, shared by all its threads. The first reason to stop stays.
#[derive(Debug, Default)]
pub struct Control {
    deadline: Option<Instant>,
    memory: Option<usize>,
    pieces: Option<usize>,
    cancel: Option<CancelToken>,
    /// A [`StopReason`], or 0.
    reason: AtomicU8,
}

impl Control {
    /// Control of a computation that starts now.
    pub fn start(limits: &Limits) -> Self {
        Self {
            deadline: limits.deadline(),
            memory: limits.memory,
            pieces: limits.pieces,
            cancel: limits.cancel.clone(),
            ..Self::default()
        }
    }

    /// The same limits with another deadline, for one part of a computation.
    #[must_use]
    pub fn until(mut self, deadline: Option<Instant>) -> Self {
        self.deadline = deadline;
        self
    }

    /// The same limits, with this many bytes counted against the memory limit.
    #[must_use]
    pub fn holding(mut self, bytes: usize) -> Self {
        self.memory = self.memory.map(|most| most.saturating_sub(bytes));
        self
    }

    /// Tells all threads to stop. The first reason stays.
    pub fn stop(&self, reason: StopReason) {
        // No other data depends on the flag.
        let _ = self.reason.compare_exchange(0, reason as u8, Ordering::Relaxed, Ordering::Relaxed);
    }

    /// Whether to stop: after [`Control::stop`], when it was cancelled, or once the deadline has passed.
    ///
    /// # Cost
    /// Reads the clock where there is a deadline: some 25 nanoseconds.
    pub fn is_stopped(&self) -> bool {
        if self.reason.load(Ordering::Relaxed) != 0 {
            return true;
        }
        if self.cancel.as_ref().is_some_and(CancelToken::is_cancelled) {
            self.stop(StopReason::Cancelled);
            return true;
        }
        let late = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        if late {
            self.stop(StopReason::Time);
        }
        late
    }

    /// Stops the computation if this many bytes exceed the memory limit.
    pub fn check_memory(&self, bytes: usize) {
        if self.memory.is_some_and(|most| bytes > most) {
            self.stop(StopReason::Memory);
        }
    }

    /// Stops the computation if this many pieces exceed the limit.
    pub fn check_pieces(&self, pieces: usize) {
        if self.pieces.is_some_and(|most| pieces > most) {
            self.stop(StopReason::Pieces);
        }
    }

    /// The reason to stop, if there is one.
    pub fn reason(&self) -> Option<StopReason> {
        let reason = self.reason.load(Ordering::Relaxed);
        StopReason::ALL.into_iter().find(|r| *r as u8 == reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn the_first_reason_stays() {
        let control = Control::start(&Limits { memory: Some(10), pieces: Some(5), ..Limits::default() });
        control.check_memory(10);
        control.check_pieces(5);
        assert!(!control.is_stopped());
        control.check_pieces(6);
        control.check_memory(11);
        control.stop(StopReason::Cancelled);
        assert!(control.is_stopped());
        assert_eq!(control.reason(), Some(StopReason::Pieces));
    }

    #[test]
    fn every_reason_is_remembered() {
        for reason in StopReason::ALL {
            let control = Control::default();
            control.stop(reason);
            assert_eq!(control.reason(), Some(reason));
        }
    }

    #[test]
    fn stops_at_the_deadline() {
        let control = Control::start(&Limits { time: Some(Duration::ZERO), ..Limits::default() });
        assert!(control.is_stopped());
        assert_eq!(control.reason(), Some(StopReason::Time));
        let limits = Limits { time: Some(Duration::from_hours(1)), ..Limits::default() };
        assert!(!Control::start(&limits).is_stopped());
        assert!(Control::start(&limits).until(Some(Instant::now())).is_stopped());
    }

    #[test]
    fn memory_that_is_held_counts() {
        let control = Control::start(&Limits { memory: Some(10), ..Limits::default() }).holding(8);
        control.check_memory(2);
        assert!(!control.is_stopped());
        control.check_memory(3);
        assert_eq!(control.reason(), Some(StopReason::Memory));
    }
}
