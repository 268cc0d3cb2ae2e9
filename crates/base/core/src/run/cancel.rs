//! Cancelling a computation from outside.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cancels computations from any thread, at any time: those whose [`Limits`](super::Limits) hold a clone of it. Clones are one token.
///
/// # Example
/// ```
/// use pompeiu_core::run::{CancelToken, Control, Limits, StopReason};
///
/// let token = CancelToken::default();
/// let control = Control::start(&Limits { cancel: Some(token.clone()), ..Limits::default() });
/// assert!(!control.is_stopped());
/// std::thread::spawn(move || token.cancel()).join().unwrap();
/// assert!(control.is_stopped());
/// assert_eq!(control.reason(), Some(StopReason::Cancelled));
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Cancels, for good.
    pub fn cancel(&self) {
        // No other data depends on the flag.
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`CancelToken::cancel`] was called on this token or a clone of it.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Whether both are clones of one token.
impl PartialEq for CancelToken {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for CancelToken {}
