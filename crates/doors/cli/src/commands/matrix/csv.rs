//! The matrix as a table of comma-separated values.

use super::run::Answer;
use crate::numbers::shortest;
use anyhow::Context;

impl Answer {
    /// The enclosure in the line of a pair.
    pub(super) fn bounds(&self, i: usize, j: usize) -> Option<[f64; 2]> {
        if self.directed { self.matrix.directed(i, j) } else { self.matrix.symmetric(i, j) }
    }
}

/// A line for each pair, empty bounds where one of the two cannot be used, or was not measured.
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
