//! The matrix as a table and as JSON.

use super::Answer;
use crate::json::milliseconds;
use crate::numbers::shortest;
use anyhow::Context;
use serde::Serialize;

impl Answer {
    /// The enclosure in the line of a pair.
    fn bounds(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        if self.directed { self.matrix.directed(i, j) } else { self.matrix.symmetric(i, j) }
    }

    /// Square arrays of one end of the enclosures.
    fn square(&self, end: usize) -> Vec<Vec<Option<f64>>> {
        let all = 0..self.names.len();
        let unusable = |i: usize| self.problems.iter().any(|problem| problem.path == self.names[i]);
        let entry = |i: usize, j: usize| self.bounds(i, j).filter(|_| !unusable(i)).map(|bounds| bounds[end]);
        all.clone().map(|i| all.clone().map(|j| entry(i, j)).collect()).collect()
    }
}

/// A line for each pair, empty bounds where one of the two cannot be used.
pub(super) fn csv(answer: &Answer) -> anyhow::Result<String> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(if answer.directed {
        ["from", "to", "lower", "upper"]
    } else {
        ["a", "b", "lower", "upper"]
    })?;
    let count = answer.names.len();
    for i in 0..count {
        for j in 0..count {
            if i == j || (i > j && !answer.directed) {
                continue;
            }
            let [lower, upper] = match answer.bounds(i, j) {
                Some(bounds) => bounds.map(shortest),
                None => [String::new(), String::new()],
            };
            table.write_record([answer.names[i].as_str(), answer.names[j].as_str(), &lower, &upper])?;
        }
    }
    let bytes = table.into_inner().context("the table could not be made")?;
    Ok(String::from_utf8(bytes)?)
}

#[derive(Serialize)]
struct Json<'a> {
    files: &'a [String],
    /// A fraction of the diagonal of the box around both meshes.
    tolerance: f64,
    /// Whether entry i, j is h(i, j) instead of H(i, j).
    directed: bool,
    lower: Vec<Vec<Option<f64>>>,
    upper: Vec<Vec<Option<f64>>>,
    failed: Vec<Failed<'a>>,
    distances: u64,
    timing_ms: f64,
}

#[derive(Serialize)]
struct Failed<'a> {
    path: &'a str,
    message: &'a str,
}

pub(super) fn json(answer: &Answer) -> serde_json::Result<String> {
    let failed =
        answer.problems.iter().map(|problem| Failed { path: &problem.path, message: &problem.message });
    let json = Json {
        files: &answer.names,
        tolerance: answer.tolerance,
        directed: answer.directed,
        lower: answer.square(0),
        upper: answer.square(1),
        failed: failed.collect(),
        distances: answer.matrix.distances(),
        timing_ms: milliseconds(answer.total),
    };
    Ok(serde_json::to_string(&json)? + "\n")
}
