//! Waiting for work without holding up Python: other threads run, Ctrl-C stops it, and progress is told.

use pompeiu::core::run::{self, CancelToken, ProgressObserver};
use pompeiu::hausdorff::{Direction, Observer, Progress};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyTuple};
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at signals, and between two calls that tell progress.
const TICK: Duration = Duration::from_millis(50);

/// What work has in hand to tell how far it has come, and to see that it shall stop.
pub(crate) struct Watch<'w, T> {
    stop: &'w CancelToken,
    sender: Sender<T>,
    last: Mutex<Option<Instant>>,
}

impl<T> Watch<'_, T> {
    /// Whether to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.is_cancelled()
    }

    /// What is cancelled then, for limits of work that tells nothing for a while.
    pub(crate) fn token(&self) -> CancelToken {
        self.stop.clone()
    }

    /// Tells how far the work has come, unless that was told a moment ago.
    pub(crate) fn tell(&self, told: T) {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.is_none_or(|last| last.elapsed() >= TICK) {
            *last = Some(Instant::now());
            // Nobody listens any more only when the work is about to be stopped.
            let _ = self.sender.send(told);
        }
    }
}

impl Observer for Watch<'_, Progress> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        self.tell(*progress);
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// What a callback in Python is called with.
pub(crate) trait Told: Send {
    /// The arguments.
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>>;
}

impl Told for Progress {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let Self { lower, upper, examined, left, .. } = *self;
        (direction(self.direction), lower, upper, examined, left).into_pyobject(py)
    }
}

/// The share that is done, between 0 and 1.
pub(crate) struct Share(f64);

impl Told for Share {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.0,).into_pyobject(py)
    }
}

impl ProgressObserver for Watch<'_, Share> {
    fn progress(&self, progress: &run::Progress<'_>) -> ControlFlow<()> {
        self.tell(Share(progress.share.unwrap_or(0.0)));
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Callbacks are told the share.
    fn reads_doing(&self) -> bool {
        false
    }
}

/// Does work on a thread of its own while this one waits, without the interpreter's lock.
///
/// Signals are only seen by the thread that Python runs on, and a callback expects to be called there too: so the work is
/// what moves. A signal, or an exception in the callback, stops the work and is raised once it has ended. When the callback
/// returns `False`, the work is stopped and what it gives is the answer.
pub(crate) fn run<T: Told, R: Send>(
    py: Python<'_>,
    callback: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut Watch<'_, T>) -> R + Send,
) -> PyResult<R> {
    let callback = callback.map(|callback| callback.clone().unbind());
    py.detach(|| {
        let stop = CancelToken::default();
        let (sender, receiver) = channel();
        thread::scope(|scope| {
            let working = scope.spawn(|| work(&mut Watch { stop: &stop, sender, last: Mutex::new(None) }));
            let raised = listen(&receiver, callback.as_ref(), &stop);
            let answer = working.join().unwrap_or_else(|panic| resume_unwind(panic));
            raised.map(|()| answer)
        })
    })
}

/// As [`run`], for work that may look rarely whether it shall stop: a signal, or an exception in the callback, is raised at once. The work
/// then goes on by itself until it sees that it shall stop, and what it gives is dropped.
pub(crate) fn run_detached<T: Told + 'static, R: Send + 'static>(
    py: Python<'_>,
    callback: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut Watch<'_, T>) -> R + Send + 'static,
) -> PyResult<R> {
    let callback = callback.map(|callback| callback.clone().unbind());
    py.detach(|| {
        let stop = CancelToken::default();
        let (sender, receiver) = channel();
        let seen = stop.clone();
        let working = thread::spawn(move || work(&mut Watch { stop: &seen, sender, last: Mutex::new(None) }));
        listen(&receiver, callback.as_ref(), &stop)?;
        Ok(working.join().unwrap_or_else(|panic| resume_unwind(panic)))
    })
}

/// As [`run_detached`], for work that cannot be told to stop.
pub(crate) fn abandonable<R: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<R> {
    run_detached(py, None, |_: &mut Watch<'_, Share>| work())
}

/// Until the work has ended. When the callback returns `False` the work is told to stop, and nothing is told any more; a signal, or an
/// exception in the callback, is returned at once.
fn listen<T: Told>(
    receiver: &Receiver<T>,
    mut callback: Option<&Py<PyAny>>,
    stop: &CancelToken,
) -> PyResult<()> {
    loop {
        let told = match receiver.recv_timeout(TICK) {
            Ok(told) => Some(told),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        let goes_on: PyResult<bool> = Python::attach(|py| {
            py.check_signals()?;
            match (callback, told) {
                (Some(callback), Some(told)) => {
                    let answer = callback.bind(py).call1(told.arguments(py)?)?;
                    Ok(!answer.is(PyBool::new(py, false)))
                }
                _ => Ok(true),
            }
        });
        if !matches!(goes_on, Ok(true)) {
            stop.cancel();
            goes_on?;
            callback = None;
        }
    }
}

/// The name of a direction.
pub(crate) fn direction(direction: Direction) -> &'static str {
    match direction {
        Direction::AToB => "a_to_b",
        Direction::BToA => "b_to_a",
    }
}
