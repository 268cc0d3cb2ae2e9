//! Who is told how far an answer has come.

use pompeiu::core::run::{CancelToken, Progress, ProgressObserver};
use pompeiu::hausdorff::{self, Direction, Observer};
use serde::Serialize;
use std::ops::ControlFlow;

/// How far an answer has come.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Told<'t> {
    /// The current activity, in a few words.
    pub doing: &'t str,
    /// The share that is done, between 0 and 1; null where it is unknown.
    pub share: Option<f64>,
    /// Which direction is searched: `a_to_b` or `b_to_a`; null outside of a search.
    pub direction: Option<&'static str>,
    /// Bounds of the largest distance of that direction so far, not yet certified.
    pub bounds: Option<[f64; 2]>,
}

/// Receives what is told. A native program ends the work with [`ControlFlow::Break`] or a token; a page ends its worker.
pub trait Watcher: Sync + Send {
    /// Called a few times a second, by one thread at a time.
    fn told(&self, told: &Told<'_>) -> ControlFlow<()>;

    /// What ends the work also where nothing is told.
    fn cancel(&self) -> Option<CancelToken> {
        None
    }
}

/// Nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Watcher for Silent {
    fn told(&self, _: &Told<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// A watcher as the systems tell it.
pub(crate) struct Watching<'w>(pub(crate) &'w dyn Watcher);

impl ProgressObserver for Watching<'_> {
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()> {
        self.0.told(&Told { doing: progress.doing, share: progress.share, direction: None, bounds: None })
    }
}

impl Observer for Watching<'_> {
    fn progress(&self, progress: &hausdorff::Progress) -> ControlFlow<()> {
        let (direction, doing) = match progress.direction {
            Direction::AToB => ("a_to_b", "A to B"),
            Direction::BToA => ("b_to_a", "B to A"),
        };
        self.0.told(&Told {
            doing,
            share: Some(progress.share),
            direction: Some(direction),
            bounds: Some([progress.lower, progress.upper]),
        })
    }
}
