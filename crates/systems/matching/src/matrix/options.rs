//! Options of a distance matrix.

use crate::tasks::TaskObserver;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{OptionError, Tolerance};

/// Options of a distance matrix; by default the default tolerance of a distance, without limits.
#[derive(Clone, Debug, Default)]
pub struct MatrixOptions<'o> {
    /// Width of each enclosure.
    pub tolerance: Tolerance,
    /// Time, memory and threads. Preparing a mesh is not interrupted. The limits on memory and on pieces apply to each
    /// search; with a memory limit, pairs are measured one after another.
    pub limits: Limits,
    /// Receives progress.
    pub observer: Option<&'o dyn TaskObserver>,
}

impl MatrixOptions<'_> {
    /// Checks that the options are valid.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`].
    pub fn check(&self) -> Result<(), OptionError> {
        self.tolerance.check()
    }
}
