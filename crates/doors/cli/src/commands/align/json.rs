//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::hausdorff::DirectedReport;
use pompeiu::matching::align::{Registration, TransformSettings};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json {
        moving: &outcome.moving,
        fixed: &outcome.fixed,
        registration: &outcome.found,
        unique: outcome.found.is_unique(),
        paraview: outcome.found.transform_settings(),
        moved_to_fixed: &outcome.distance.a_to_b,
        fixed_to_moved: &outcome.distance.b_to_a,
        timing_ms: Timing {
            read: milliseconds(outcome.read),
            align: milliseconds(outcome.aligned),
            distance: milliseconds(outcome.measured),
            total: milliseconds(outcome.total),
        },
    })
}

/// The answer of `pompeiu align --json`. Lengths are in the unit of the files.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Align"))]
pub(crate) struct Json<'o> {
    /// The mesh that was moved, as its file states it.
    moving: &'o File,
    /// The mesh that stayed.
    fixed: &'o File,
    #[serde(flatten)]
    registration: &'o Registration,
    /// Whether it fits, no other place that was tried fits nearly as well, and no motion is free.
    unique: bool,
    /// The map as `ParaView`'s filter Transform takes it.
    paraview: TransformSettings,
    /// How far the moved mesh is from the fixed one.
    moved_to_fixed: &'o DirectedReport,
    /// How far the fixed mesh is from the moved one.
    fixed_to_moved: &'o DirectedReport,
    timing_ms: Timing,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    read: f64,
    align: f64,
    distance: f64,
    total: f64,
}
