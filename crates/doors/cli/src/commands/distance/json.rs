//! The outcome as one JSON object.

use super::outcome::{Answer, Outcome};
use super::watch::TraceRow;
use crate::args::ToleranceKind;
use crate::json::{line, milliseconds};
use crate::pair::File;
use pompeiu::hausdorff::{DirectedReport, Direction, Enclosure, PointPair, StopReason, WorkCount};
use pompeiu::matching::align::Registration;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    line(&Json {
        a: &outcome.a,
        b: &outcome.b,
        alignment: outcome.alignment.as_ref(),
        tolerance: Tolerance {
            requested: outcome.requested,
            kind: outcome.kind,
            absolute: outcome.tolerance(),
        },
        a_to_b: outcome.a_to_b.as_ref().map(|report| Directed::new(report, Direction::AToB)),
        b_to_a: outcome.b_to_a.as_ref().map(|report| Directed::new(report, Direction::BToA)),
        hausdorff: outcome.hausdorff(),
        threshold: outcome.answer().map(|(value, answer)| Threshold { value, answer }),
        trace: outcome.trace.as_ref().map(|rows| rows.iter().map(Row::from).collect()),
        timing_ms: Timing {
            read: milliseconds(outcome.times.read),
            build: milliseconds(outcome.build()),
            search: milliseconds(outcome.search()),
            total: milliseconds(outcome.times.total),
        },
    })
}

/// The answer of `pompeiu distance --json`. Lengths are in the unit of the files.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Distance"))]
pub(crate) struct Json<'o> {
    a: &'o File,
    b: &'o File,
    /// How B was moved onto A before; absent if that was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    alignment: Option<&'o Registration>,
    tolerance: Tolerance,
    /// How far A is from B; absent if only the other direction was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    a_to_b: Option<Directed>,
    /// How far B is from A; absent if only the other direction was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    b_to_a: Option<Directed>,
    /// The Pompeiu–Hausdorff distance, the greater of both directed ones; absent if only one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    hausdorff: Option<Enclosure>,
    /// Whether the distance is at most a length; absent if that was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    threshold: Option<Threshold>,
    /// How the interval narrowed; absent if that was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    trace: Option<Vec<Row>>,
    timing_ms: Timing,
}

/// The width of the interval that was asked for.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Tolerance {
    /// The number as given.
    requested: f64,
    /// What it is measured in.
    kind: ToleranceKind,
    /// The same as a length.
    absolute: f64,
}

/// One of the two directed distances.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Directed {
    #[serde(flatten)]
    distance: Enclosure,
    /// Why the search ended; the interval holds in every case.
    stop: StopReason,
    /// The points that prove the lower end.
    witness: PointPair,
    /// What it took.
    work: WorkCount,
}

impl Directed {
    fn new(report: &DirectedReport, direction: Direction) -> Self {
        let DirectedReport { distance, stop, work, .. } = *report;
        Self { distance, stop, witness: report.witness.by_mesh(direction), work }
    }
}

/// Whether the distance is at most a length.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Threshold {
    /// The length.
    value: f64,
    answer: Answer,
}

/// How far a search had come at one tolerance.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "TraceRow"))]
struct Row {
    direction: Direction,
    /// A fraction of the joint diagonal.
    tolerance: f64,
    /// The same as a length.
    absolute: f64,
    /// Lower bound so far.
    lower: f64,
    /// Upper bound so far.
    upper: f64,
    /// Pieces that may still hold the maximum; null where the search was stopped.
    pieces: Option<usize>,
    /// Point–triangle distances evaluated so far.
    distances: u64,
    /// Time so far.
    time_ms: f64,
}

impl From<&TraceRow> for Row {
    fn from(row: &TraceRow) -> Self {
        Self {
            direction: row.direction,
            tolerance: row.fraction,
            absolute: row.tolerance,
            lower: row.lower,
            upper: row.upper,
            pieces: row.pieces,
            distances: row.distances,
            time_ms: milliseconds(row.elapsed),
        }
    }
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    read: f64,
    build: f64,
    search: f64,
    total: f64,
}
