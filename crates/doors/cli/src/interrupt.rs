//! Ctrl-C: the first ends a search with what it has proven, the second ends the program.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What shells say of a program that ended by Ctrl-C.
const ENDED_BY_INTERRUPT: i32 = 130;

/// Leaves Ctrl-C to [`flow`] from now on. Where the system has no such thing, it ends the program as before.
pub(crate) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(ENDED_BY_INTERRUPT);
        }
    });
}

/// Whether to go on.
pub(crate) fn flow() -> ControlFlow<()> {
    if INTERRUPTED.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
