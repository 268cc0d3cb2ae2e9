//! When to stop before the end.

use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Instant;

/// Why a search was told to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Halt {
    Time = 1,
    Memory = 2,
    Cancelled = 3,
    Threshold = 4,
}

/// Limits of one search, watched by all its tasks.
#[derive(Debug)]
pub(crate) struct Control {
    deadline: Option<Instant>,
    /// Bytes that pieces may take.
    memory: Option<usize>,
    state: AtomicU8,
}

impl Control {
    pub(crate) fn new(deadline: Option<Instant>, memory: Option<usize>) -> Self {
        Self { deadline, memory, state: AtomicU8::new(0) }
    }

    /// Tells all tasks to stop; the first reason stays.
    pub(crate) fn halt(&self, why: Halt) {
        // No other data hangs on the flag.
        let _ = self.state.compare_exchange(0, why as u8, Ordering::Relaxed, Ordering::Relaxed);
    }

    pub(crate) fn halted(&self) -> bool {
        if self.state.load(Ordering::Relaxed) != 0 {
            return true;
        }
        let late = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        if late {
            self.halt(Halt::Time);
        }
        late
    }

    pub(crate) fn mind_memory(&self, bytes: usize) {
        if self.memory.is_some_and(|most| bytes > most) {
            self.halt(Halt::Memory);
        }
    }

    pub(crate) fn why(&self) -> Option<Halt> {
        match self.state.load(Ordering::Relaxed) {
            0 => None,
            1 => Some(Halt::Time),
            2 => Some(Halt::Memory),
            3 => Some(Halt::Cancelled),
            _ => Some(Halt::Threshold),
        }
    }
}
