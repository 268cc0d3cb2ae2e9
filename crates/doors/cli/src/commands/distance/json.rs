//! The outcome as one JSON object. Doubles are written as the shortest decimals that read back to them.

use super::args::ToleranceKind;
use super::outcome::{Answer, Outcome};
use super::watch::TraceRow;
use crate::json::{Bounds, MeshFile, WitnessPoints, milliseconds};
use pompeiu::hausdorff::{DirectedReport, Direction, WorkCount};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let report = Report {
        a: MeshFile::from(&outcome.a),
        b: MeshFile::from(&outcome.b),
        tolerance: Tolerance {
            requested: outcome.requested,
            kind: match outcome.kind {
                ToleranceKind::Diagonal => "diagonal",
                ToleranceKind::Relative => "relative",
                ToleranceKind::Absolute => "absolute",
            },
            absolute: outcome.tolerance(),
        },
        a_to_b: outcome.a_to_b.as_ref().map(|report| Directed::new(report, Direction::AToB)),
        b_to_a: outcome.b_to_a.as_ref().map(|report| Directed::new(report, Direction::BToA)),
        hausdorff: outcome.hausdorff().map(Bounds::from),
        threshold: outcome.answer().map(|(value, answer)| Threshold {
            value,
            answer: match answer {
                Answer::Below => "below",
                Answer::Above => "above",
                Answer::Undecided => "undecided",
            },
        }),
        trace: outcome.trace.as_ref().map(|rows| rows.iter().map(Row::from).collect()),
        timing_ms: Timing {
            read: milliseconds(outcome.times.read),
            build: milliseconds(outcome.build()),
            search: milliseconds(outcome.search()),
            total: milliseconds(outcome.times.total),
        },
    };
    Ok(serde_json::to_string(&report)? + "\n")
}

#[derive(Serialize)]
struct Report<'o> {
    a: MeshFile<'o>,
    b: MeshFile<'o>,
    tolerance: Tolerance,
    #[serde(skip_serializing_if = "Option::is_none")]
    a_to_b: Option<Directed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    b_to_a: Option<Directed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hausdorff: Option<Bounds>,
    #[serde(skip_serializing_if = "Option::is_none")]
    threshold: Option<Threshold>,
    #[serde(skip_serializing_if = "Option::is_none")]
    trace: Option<Vec<Row>>,
    timing_ms: Timing,
}

#[derive(Serialize)]
struct Tolerance {
    requested: f64,
    kind: &'static str,
    absolute: f64,
}

#[derive(Serialize)]
struct Directed {
    lower: f64,
    upper: f64,
    stop: &'static str,
    witness: WitnessPoints,
    work: Work,
}

#[derive(Serialize)]
struct Work {
    queries: u64,
    distances: u64,
    pieces: u64,
    games: u64,
    cuts: u64,
    depth: u32,
}

impl From<WorkCount> for Work {
    fn from(work: WorkCount) -> Self {
        let WorkCount { queries, distances, pieces, games, cuts, depth } = work;
        Self { queries, distances, pieces, games, cuts, depth }
    }
}

impl Directed {
    fn new(report: &DirectedReport, direction: Direction) -> Self {
        Self {
            lower: report.distance.lower(),
            upper: report.distance.upper(),
            stop: report.stop.name(),
            witness: WitnessPoints::new(&report.witness, direction),
            work: report.work.into(),
        }
    }
}

#[derive(Serialize)]
struct Threshold {
    value: f64,
    answer: &'static str,
}

#[derive(Serialize)]
struct Row {
    direction: &'static str,
    /// A fraction of the joint diagonal.
    tolerance: f64,
    /// The same as a length.
    absolute: f64,
    lower: f64,
    upper: f64,
    /// Null where the search was stopped.
    pieces: Option<usize>,
    distances: u64,
    time_ms: f64,
}

impl From<&TraceRow> for Row {
    fn from(row: &TraceRow) -> Self {
        Self {
            direction: match row.direction {
                Direction::AToB => "a_to_b",
                Direction::BToA => "b_to_a",
            },
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

#[derive(Serialize)]
struct Timing {
    read: f64,
    build: f64,
    search: f64,
    total: f64,
}
