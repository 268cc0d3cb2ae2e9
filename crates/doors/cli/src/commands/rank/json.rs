//! The ranking as one JSON object.

use super::run::Answer;
use crate::json::{MeshFile, milliseconds};
use pompeiu::matching::align::Matrix;
use pompeiu::matching::rank::{Bound, Standing, Status, Work};
use serde::Serialize;

#[derive(Serialize)]
struct Json<'a> {
    template: MeshFile<'a>,
    options: &'a pompeiu::matching::rank::Options,
    targets: Vec<Target<'a>>,
    work: &'a Work,
    timing_ms: f64,
}

/// A row of the table: the same in JSON and CSV.
#[derive(Serialize)]
pub(super) struct Target<'a> {
    pub(super) path: &'a str,
    /// `ranked`, `discarded` or `failed`.
    pub(super) status: &'static str,
    pub(super) rank_first: Option<usize>,
    pub(super) rank_last: Option<usize>,
    pub(super) lower: Option<f64>,
    pub(super) upper: Option<f64>,
    pub(super) vertices: Option<usize>,
    pub(super) faces: Option<usize>,
    /// What proved that a target is not among the best: `supports`, `probes` or `search`.
    pub(super) discarded_by: Option<&'static str>,
    pub(super) message: Option<&'a str>,
    /// In JSON four rows of four numbers.
    pub(super) transform: Option<Matrix>,
}

pub(super) fn targets(answer: &Answer) -> Vec<Target<'_>> {
    let row = |standing: &'_ Standing| -> (&'static str, Option<&'static str>) {
        match standing.status {
            Status::Ranked => ("ranked", None),
            Status::Discarded(Bound::Supports) => ("discarded", Some("supports")),
            Status::Discarded(Bound::Probes) => ("discarded", Some("probes")),
            Status::Discarded(Bound::Search(_)) => ("discarded", Some("search")),
            Status::Failed(_) => ("failed", None),
        }
    };
    let standings = answer.report.standings.iter().map(|standing| {
        let (status, discarded_by) = row(standing);
        Target {
            path: &standing.name,
            status,
            rank_first: standing.ranks.map(|ranks| ranks[0]),
            rank_last: standing.ranks.map(|ranks| ranks[1]),
            lower: standing.lower,
            upper: standing.upper,
            vertices: standing.size.map(|size| size[0]),
            faces: standing.size.map(|size| size[1]),
            discarded_by,
            message: match &standing.status {
                Status::Failed(message) => Some(message),
                _ => None,
            },
            transform: standing.transform,
        }
    });
    let problems = answer.problems.iter().map(|problem| Target {
        path: &problem.path,
        status: "failed",
        rank_first: None,
        rank_last: None,
        lower: None,
        upper: None,
        vertices: None,
        faces: None,
        discarded_by: None,
        message: Some(&problem.message),
        transform: None,
    });
    standings.chain(problems).collect()
}

pub(super) fn json(answer: &Answer) -> serde_json::Result<String> {
    let json = Json {
        template: (&answer.template).into(),
        options: &answer.options,
        targets: targets(answer),
        work: &answer.report.work,
        timing_ms: milliseconds(answer.total),
    };
    Ok(serde_json::to_string(&json)? + "\n")
}
