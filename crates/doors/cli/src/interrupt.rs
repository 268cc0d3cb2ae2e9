//! Ctrl-C: the first ends a computation with what it has found, the second ends the program. While a file is written the first one
//! ends the program: the answer is printed, and the file is as it was before.

use crate::printer::Printer;
use pompeiu::core::run::CancelToken;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError};

static INTERRUPTED: LazyLock<CancelToken> = LazyLock::new(CancelToken::default);

/// Whether a file is written, and nothing computed.
static WRITING: AtomicBool = AtomicBool::new(false);

/// An answer that is printed after files were written.
static UNPRINTED: Mutex<Option<String>> = Mutex::new(None);

/// What shells say of a program that ended by Ctrl-C.
const ENDED_BY_INTERRUPT: i32 = 130;

/// Leaves Ctrl-C to [`flow`] from now on. Where the system has no such thing, it ends the program as before.
pub(crate) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.is_cancelled() || WRITING.load(Ordering::Relaxed) {
            if let Some(answer) = UNPRINTED.lock().unwrap_or_else(PoisonError::into_inner).take() {
                let _ = Printer::answer(&answer);
            }
            std::process::exit(ENDED_BY_INTERRUPT);
        }
        INTERRUPTED.cancel();
    });
}

/// Writes a file; Ctrl-C then ends the program. Files appear only once they are whole.
pub(crate) fn while_writing<R>(write: impl FnOnce() -> R) -> R {
    WRITING.store(true, Ordering::Relaxed);
    let written = write();
    WRITING.store(false, Ordering::Relaxed);
    written
}

/// Sets what is printed if Ctrl-C ends the program from now on.
pub(crate) fn print_if_ended(answer: Option<String>) {
    *UNPRINTED.lock().unwrap_or_else(PoisonError::into_inner) = answer;
}

/// What Ctrl-C cancels once [`listen`] was called, for work that nobody watches.
pub(crate) fn token() -> CancelToken {
    INTERRUPTED.clone()
}

/// Whether to go on.
pub(crate) fn flow() -> ControlFlow<()> {
    if INTERRUPTED.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
