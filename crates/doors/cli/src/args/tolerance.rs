//! How narrow intervals shall be.

use crate::numbers::magnitude;
use clap::{Args, ValueEnum};
use serde::Serialize;

#[derive(Args)]
pub(crate) struct Tolerance {
    /// Largest width of the proven intervals
    #[arg(long, value_parser = magnitude, allow_negative_numbers = true, default_value = "1e-12", value_name = "X")]
    pub(crate) tolerance: f64,
    /// What the tolerance is measured in
    #[arg(long, value_enum, default_value_t)]
    pub(crate) tolerance_kind: ToleranceKind,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum ToleranceKind {
    /// The diagonal of the box around both meshes
    #[default]
    Diagonal,
    /// The distance itself
    Relative,
    /// The unit of the files
    Absolute,
}

impl Tolerance {
    /// The tolerance as the library takes it.
    pub(crate) fn get(&self) -> pompeiu::hausdorff::Tolerance {
        use pompeiu::hausdorff::Tolerance;
        match self.tolerance_kind {
            ToleranceKind::Diagonal => Tolerance::RelativeToDiagonal(self.tolerance),
            ToleranceKind::Relative => Tolerance::RelativeToDistance(self.tolerance),
            ToleranceKind::Absolute => Tolerance::Absolute(self.tolerance),
        }
    }
}
