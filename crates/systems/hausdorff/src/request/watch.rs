//! Who watches a comparison: an observer of the search, and that of the context.

use crate::{Direction, MeanSoFar, Observer, Progress, digits};
use pompeiu_core::run::{self, CancelToken, ProgressObserver, RunContext};
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

/// Passes progress on, and ends the work when it is cancelled.
pub(super) struct Watch<'w> {
    progress: Option<&'w dyn ProgressObserver>,
    observer: Option<&'w dyn Observer>,
    cancel: Option<CancelToken>,
    /// What is known of the mean distance, of the direction that was told last.
    mean: Mutex<Option<(Direction, MeanSoFar)>>,
}

impl<'w> Watch<'w> {
    pub(super) fn new(context: &RunContext<'w>, observer: Option<&'w dyn Observer>) -> Self {
        Self {
            progress: context.progress(),
            observer,
            cancel: context.limits().cancel,
            mean: Mutex::default(),
        }
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
        let known = *self.mean.lock().unwrap_or_else(PoisonError::into_inner);
        let mean = known.filter(|(direction, _)| *direction == progress.direction).map(|(_, mean)| mean);
        self.progress.map_or(ControlFlow::Continue(()), |watching| tell(watching, progress, mean))
    }

    fn wants_mean(&self) -> bool {
        self.progress.is_some_and(ProgressObserver::reads_doing)
            || self.observer.is_some_and(Observer::wants_mean)
    }

    fn mean(&self, direction: Direction, mean: MeanSoFar) {
        if let Some(observer) = self.observer {
            observer.mean(direction, mean);
        }
        let mut known = self.mean.lock().unwrap_or_else(PoisonError::into_inner);
        // Samples say more than an enclosure that is still wide.
        let says_less = matches!((*known, mean), (Some((of, MeanSoFar::Sampled(_))), MeanSoFar::Enclosed(ends))
            if of == direction && ends.gap() > WIDE * ends.upper());
        if !says_less {
            *known = Some((direction, mean));
        }
    }
}

/// Enclosures of a mean that are wider than this part of their upper end are not shown instead of a sampled mean.
const WIDE: f64 = 0.3;

/// Tells an observer of a context how far a search has come.
pub(super) fn tell(
    watching: &dyn ProgressObserver,
    progress: &Progress,
    mean: Option<MeanSoFar>,
) -> ControlFlow<()> {
    let ends = match progress.direction {
        Direction::AToB => "A to B",
        Direction::BToA => "B to A",
    };
    let largest = digits::between(progress.lower, progress.upper);
    let doing = match mean {
        None => format!("{ends}: {largest}"),
        Some(MeanSoFar::Sampled(mean)) => {
            format!("{ends}: largest {largest}, mean about {} (sampled)", digits::brief(mean, mean))
        }
        Some(MeanSoFar::Enclosed(mean)) => {
            format!("{ends}: largest {largest}, mean {}", digits::between(mean.lower(), mean.upper()))
        }
    };
    watching.progress(&run::Progress { doing: &doing, share: Some(progress.share) })
}
