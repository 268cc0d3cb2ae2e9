//! Waiting for a search without holding up Python: other threads run, Ctrl-C stops it, and progress is told.

use pompeiu::hausdorff::{Direction, Observer, Progress};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at signals, and between two calls that tell progress.
const TICK: Duration = Duration::from_millis(50);

/// Passes progress on to the thread that waits, and the wish to stop back.
struct Watch<'w> {
    stop: &'w AtomicBool,
    sender: Sender<Progress>,
    last: Option<Instant>,
}

impl Observer for Watch<'_> {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        if self.stop.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        if self.last.is_none_or(|last| last.elapsed() >= TICK) {
            self.last = Some(Instant::now());
            // Nobody listens any more only when this search is about to be stopped.
            let _ = self.sender.send(*progress);
        }
        ControlFlow::Continue(())
    }
}

/// Runs a search on a thread of its own while this one waits, without the interpreter's lock.
///
/// Signals are only seen by the thread that Python runs on, and a callback expects to be called there too: so the search
/// is what moves. A signal or an exception in the callback stops the search and is raised once it has ended; so is nothing
/// when the callback returns `False`: the search then ends with what is proven.
pub(crate) fn run<R: Send>(
    py: Python<'_>,
    callback: Option<&Bound<'_, PyAny>>,
    search: impl FnOnce(&mut dyn Observer) -> R + Send,
) -> PyResult<R> {
    let callback = callback.map(|callback| callback.clone().unbind());
    py.detach(|| {
        let stop = AtomicBool::new(false);
        let (sender, receiver) = channel();
        thread::scope(|scope| {
            let searching = scope.spawn(|| {
                let mut watch = Watch { stop: &stop, sender, last: None };
                search(&mut watch)
            });
            let raised = listen(&receiver, callback.as_ref(), &stop);
            let answer = searching.join().unwrap_or_else(|panic| resume_unwind(panic));
            raised.map(|()| answer)
        })
    })
}

/// Until the search has ended, or has been told to.
fn listen(receiver: &Receiver<Progress>, callback: Option<&Py<PyAny>>, stop: &AtomicBool) -> PyResult<()> {
    loop {
        let told = match receiver.recv_timeout(TICK) {
            Ok(progress) => Some(progress),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        let goes_on = Python::attach(|py| {
            py.check_signals()?;
            match (callback, told) {
                (Some(callback), Some(progress)) => tell(py, callback, &progress),
                _ => Ok(true),
            }
        });
        match goes_on {
            Ok(true) => {}
            Ok(false) => {
                stop.store(true, Ordering::Relaxed);
                return Ok(());
            }
            Err(error) => {
                stop.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    }
}

/// Whether the search shall go on.
fn tell(py: Python<'_>, callback: &Py<PyAny>, progress: &Progress) -> PyResult<bool> {
    let direction = direction(progress.direction);
    let answer = callback.bind(py).call1((
        direction,
        progress.lower,
        progress.upper,
        progress.examined,
        progress.left,
    ))?;
    Ok(!answer.is(pyo3::types::PyBool::new(py, false)))
}

/// The name of a direction.
pub(crate) fn direction(direction: Direction) -> &'static str {
    match direction {
        Direction::AToB => "a_to_b",
        Direction::BToA => "b_to_a",
    }
}
