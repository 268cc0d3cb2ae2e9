//! The ranking as one JSON object.

use super::run::Answer;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::hausdorff::StopReason;
use pompeiu::matching::rank::{RankOptions, Row, Work};
use serde::Serialize;

/// The ranking on one line.
pub(super) fn json(answer: &Answer) -> serde_json::Result<String> {
    line(&Json {
        template: &answer.template,
        options: &answer.options,
        targets: answer.rows(),
        stop: answer.report.stop,
        work: &answer.report.work,
        timing_ms: milliseconds(answer.total),
    })
}

/// The answer of `pompeiu rank --json`. Lengths are in the unit of the files.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Rank"))]
pub(crate) struct Json<'a> {
    template: &'a File,
    /// What was asked for.
    options: &'a RankOptions<'static>,
    /// The ranked ones, best first; then those left open, and the discarded ones, by their lower bounds; then what cannot
    /// be used.
    targets: Vec<Row>,
    /// Why the ranking ended: `tolerance` unless targets are left open.
    stop: StopReason,
    /// What it took.
    work: &'a Work,
    /// Milliseconds in all.
    timing_ms: f64,
}
