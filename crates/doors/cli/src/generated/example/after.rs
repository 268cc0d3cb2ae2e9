use clap::Args;
use pompeiu::core::request::{Limit, Report, Request};
use pompeiu::core::run::StopReason;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Round the coordinates of a mesh.
#[derive(Clone, Debug, PartialEq, Args, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct RoundRequest {
    /// Digits after the point.
    #[arg(long, value_name = "N")]
    pub(crate) digits: u32,
    /// Leave vertices of boundary edges where they are.
    #[arg(long)]
    pub(crate) keep_boundary: bool,
}

impl Default for RoundRequest {
    fn default() -> Self {
        Self { digits: 3, keep_boundary: false }
    }
}

impl Request for RoundRequest {
    const NAME: &'static str = "round";
    const LIMITS: &'static [Limit] = &[Limit::Time];
    type Report = RoundReport;
}

/// What was rounded.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct RoundReport {
    /// Number of vertices that moved.
    pub(crate) moved: usize,
}

impl Report for RoundReport {
    fn stop(&self) -> StopReason {
        StopReason::Tolerance
    }
}
