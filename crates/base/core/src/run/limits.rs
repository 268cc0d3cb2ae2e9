//! Limits on time, memory, pieces and threads.

use super::{CancelToken, Instant};
use std::num::NonZeroUsize;
use std::time::Duration;

/// Limits of a computation. The default sets none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Wall-clock time, from the start of the computation.
    pub time: Option<Duration>,
    /// Memory in bytes, the input included.
    pub memory: Option<usize>,
    /// Pieces that the input may be cut into, where the computation cuts it.
    pub pieces: Option<usize>,
    /// Threads; those of the current pool where none is given. Results do not depend on it.
    pub threads: Option<NonZeroUsize>,
    /// Ends the computation when it is cancelled, with [`StopReason::Cancelled`](super::StopReason::Cancelled).
    pub cancel: Option<CancelToken>,
}

impl Limits {
    /// A time limit from a number of seconds.
    ///
    /// # Errors
    /// [`LimitError::Seconds`] for a number that is negative, not finite, or too large for a [`Duration`].
    pub fn seconds(seconds: f64) -> Result<Duration, LimitError> {
        Duration::try_from_secs_f64(seconds).map_err(|_| LimitError::Seconds(seconds))
    }

    /// A number of threads.
    ///
    /// # Errors
    /// [`LimitError::Threads`] for 0.
    pub const fn threads(count: usize) -> Result<NonZeroUsize, LimitError> {
        match NonZeroUsize::new(count) {
            Some(count) => Ok(count),
            None => Err(LimitError::Threads),
        }
    }

    /// When the time limit expires, counted from now; `None` if that is beyond the range of the clock.
    pub fn deadline(&self) -> Option<Instant> {
        self.time.and_then(|time| Instant::now().checked_add(time))
    }
}

/// A limit that makes no sense.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LimitError {
    /// A time limit that is not a span of time.
    #[error(
        "the time limit is {0} seconds; it must be a finite number that is not negative, of at most 2^64"
    )]
    Seconds(f64),
    /// No thread.
    #[error("the number of threads is 0; at least 1 is needed")]
    Threads,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_of_time_are_finite_and_not_negative() {
        assert_eq!(Limits::seconds(1.5), Ok(Duration::from_millis(1500)));
        for bad in [-1.0, f64::INFINITY, 1e300] {
            assert_eq!(Limits::seconds(bad), Err(LimitError::Seconds(bad)));
        }
        assert!(Limits::seconds(f64::NAN).is_err());
    }

    #[test]
    fn there_is_a_thread() {
        assert_eq!(Limits::threads(3).map(NonZeroUsize::get), Ok(3));
        assert_eq!(Limits::threads(0), Err(LimitError::Threads));
    }

    #[test]
    fn a_limit_beyond_the_clock_is_none() {
        assert_eq!(Limits { time: Some(Duration::MAX), ..Limits::default() }.deadline(), None);
    }
}
