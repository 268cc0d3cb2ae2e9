//! The matrix as one JSON object.

use super::run::Answer;
use crate::json::milliseconds;
use serde::Serialize;

impl Answer {
    /// Square arrays of one end of the enclosures.
    fn square(&self, end: usize) -> Vec<Vec<Option<f64>>> {
        let all = 0..self.names.len();
        let unusable = |i: usize| self.problems.iter().any(|problem| problem.path == self.names[i]);
        let entry = |i: usize, j: usize| self.bounds(i, j).filter(|_| !unusable(i)).map(|bounds| bounds[end]);
        all.clone().map(|i| all.clone().map(|j| entry(i, j)).collect()).collect()
    }
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
