//! Work that nothing can interrupt.

use super::Control;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How often the control is asked while the work is done.
const INTERVAL: Duration = Duration::from_millis(5);

/// Does work that cannot be interrupted on a thread of its own, and gives it up where the control stops: `None` then.
///
/// # Limits
/// Work that was given up goes on to its end, with the memory that it takes; only its result is dropped. Where no thread can be made, as
/// in a page, the work is done in any case.
///
/// # Panics
/// Where the work does.
pub fn unless_stopped<R: Send + 'static>(
    control: &Control,
    work: impl FnOnce() -> R + Send + 'static,
) -> Option<R> {
    if cfg!(target_family = "wasm") {
        return Some(work());
    }
    let (sender, receiver) = channel();
    let thread = std::thread::spawn(move || sender.send(work()));
    loop {
        match receiver.recv_timeout(INTERVAL) {
            Ok(found) => return Some(found),
            Err(RecvTimeoutError::Timeout) if control.is_stopped() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match thread.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(_) => return None,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Limits, StopReason};

    #[test]
    fn work_is_done_or_given_up() {
        assert_eq!(unless_stopped(&Control::default(), || 7), Some(7));
        let (sender, receiver) = channel::<()>();
        let limits = Limits { time: Some(Duration::from_millis(20)), ..Limits::default() };
        let control = Control::start(&limits);
        // Work that ends only when the sender is dropped, which is after it was given up.
        assert_eq!(unless_stopped(&control, move || receiver.recv().is_ok()), None);
        assert_eq!(control.reason(), Some(StopReason::Time));
        drop(sender);
    }
}
