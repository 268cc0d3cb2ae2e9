//! Who watches a comparison: an observer of the search, and that of the context.

use crate::{Direction, Observer, Progress, digits};
use pompeiu_core::run::{self, CancelToken, ProgressObserver, RunContext};
use std::ops::ControlFlow;

/// Passes progress on, and ends the work when it is cancelled.
pub(super) struct Watch<'w> {
    progress: Option<&'w dyn ProgressObserver>,
    observer: Option<&'w dyn Observer>,
    cancel: Option<CancelToken>,
}

impl<'w> Watch<'w> {
    pub(super) fn new(context: &RunContext<'w>, observer: Option<&'w dyn Observer>) -> Self {
        Self { progress: context.progress(), observer, cancel: context.limits().cancel }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        if let Some(observer) = self.observer {
            observer.progress(progress)?;
        }
        if self.cancel.as_ref().is_some_and(CancelToken::is_cancelled) {
            return ControlFlow::Break(());
        }
        self.progress.map_or(ControlFlow::Continue(()), |watching| tell(watching, progress))
    }
}

/// Tells an observer of a context how far a search has come.
pub(super) fn tell(watching: &dyn ProgressObserver, progress: &Progress) -> ControlFlow<()> {
    let ends = match progress.direction {
        Direction::AToB => "A to B",
        Direction::BToA => "B to A",
    };
    let doing = format!("{ends}: {}", digits::between(progress.lower, progress.upper));
    let all = progress.examined.saturating_add(progress.left).max(1);
    let share = progress.examined as f64 / all as f64;
    watching.progress(&run::Progress { doing: &doing, share: Some(share) })
}
