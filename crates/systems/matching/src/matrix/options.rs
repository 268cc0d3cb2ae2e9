//! What is asked for.

use crate::tasks::TaskObserver;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{OptionError, Tolerance};

/// How to measure all pairs; the default asks for the default tolerance of a distance, without limits.
#[derive(Clone, Debug, Default)]
pub struct MatrixOptions<'o> {
    /// Width of each enclosure.
    pub tolerance: Tolerance,
    /// Time, memory and threads. Preparing a mesh is not interrupted. The limits on memory and on pieces apply to each
    /// search; with a memory limit, pairs are measured one after another.
    pub limits: Limits,
    /// Watches the tasks.
    pub observer: Option<&'o dyn TaskObserver>,
}

impl MatrixOptions<'_> {
    /// Whether the options make sense.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`].
    pub fn check(&self) -> Result<(), OptionError> {
        self.tolerance.check()
    }
}
