//! Ctrl-C: the first ends a search with what it has proven, the second ends the program.

use pompeiu::core::run::CancelToken;
use std::ops::ControlFlow;
use std::sync::LazyLock;

static INTERRUPTED: LazyLock<CancelToken> = LazyLock::new(CancelToken::default);

/// What shells say of a program that ended by Ctrl-C.
const ENDED_BY_INTERRUPT: i32 = 130;

/// Leaves Ctrl-C to [`flow`] from now on. Where the system has no such thing, it ends the program as before.
pub(crate) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.is_cancelled() {
            std::process::exit(ENDED_BY_INTERRUPT);
        }
        INTERRUPTED.cancel();
    });
}

/// What Ctrl-C cancels once [`listen`] was called, for work that nobody watches.
pub(crate) fn token() -> CancelToken {
    INTERRUPTED.clone()
}

/// Whether to go on.
pub(crate) fn flow() -> ControlFlow<()> {
    if INTERRUPTED.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
