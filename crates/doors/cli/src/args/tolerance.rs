//! How narrow intervals shall be.

use crate::numbers::magnitude;
use clap::Args;
use pompeiu::hausdorff::ToleranceKind;

#[derive(Args)]
pub(crate) struct Tolerance {
    /// Largest width of the proven intervals
    #[arg(long, value_parser = magnitude, allow_negative_numbers = true, default_value = "1e-12", value_name = "X")]
    pub(crate) tolerance: f64,
    /// What the tolerance is measured in
    #[arg(long, value_enum, default_value_t)]
    pub(crate) tolerance_kind: ToleranceKind,
}

impl Tolerance {
    /// The tolerance as the library takes it.
    pub(crate) fn get(&self) -> pompeiu::hausdorff::Tolerance {
        self.tolerance_kind.of(self.tolerance)
    }
}
