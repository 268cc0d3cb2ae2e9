//! The ranking as a table of comma-separated values.

use crate::numbers::shortest;
use anyhow::Context;
use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::BoundKind;
use pompeiu::matching::request::{RankReport, RankRequest};

const COLUMNS: [&str; 10] = [
    "path",
    "status",
    "rank_first",
    "rank_last",
    "lower",
    "upper",
    "vertices",
    "faces",
    "discarded_by",
    "message",
];

/// Doubles as the shortest decimals that read back to them; the transform as twelve numbers, row by row.
pub(super) fn csv(request: &RankRequest, report: &RankReport) -> anyhow::Result<Vec<u8>> {
    let moved = request.align != Alignment::None;
    let mut table = csv::Writer::from_writer(Vec::new());
    let mut header: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    if moved {
        header.extend((1..=3).flat_map(|i| (1..=4).map(move |j| format!("transform_{i}{j}"))));
    }
    table.write_record(&header)?;
    for target in &report.targets {
        let count = |n: Option<usize>| n.map(|n| n.to_string()).unwrap_or_default();
        let number = |x: Option<f64>| x.map(shortest).unwrap_or_default();
        let mut row = vec![
            target.path.clone(),
            target.status.name().to_owned(),
            count(target.rank_first),
            count(target.rank_last),
            number(target.lower),
            number(target.upper),
            count(target.vertices),
            count(target.faces),
            target.discarded_by.map_or("", BoundKind::name).to_owned(),
            target.message.clone().unwrap_or_default(),
        ];
        if moved {
            row.extend((0..12).map(|at| number(target.transform.map(|m| m[at / 4][at % 4]))));
        }
        table.write_record(&row)?;
    }
    table.into_inner().context("the table could not be made")
}
