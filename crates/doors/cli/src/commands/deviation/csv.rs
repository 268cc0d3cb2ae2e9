//! The statistics as comma-separated values: one row for each number, with both ends of what is proven of it.

use super::run::{Outcome, directions, percent};
use crate::numbers::shortest;
use pompeiu::hausdorff::Enclosure;
use pompeiu::hausdorff::deviation::Statistics;
use std::fmt::Write;

pub(super) fn csv(outcome: &Outcome) -> String {
    let deviation = &outcome.deviation;
    let mut rows = Rows("direction,statistic,lower,upper\n".to_owned());
    rows.push("both", "max", deviation.distance);
    for (name, directed) in directions(deviation) {
        rows.push(name, "max", directed.distance.distance);
        if let Some(statistics) = &directed.statistics {
            rows.statistics(name, statistics);
        }
    }
    for percentile in deviation.greater_percentiles.iter().flatten() {
        rows.push("greater", &format!("percentile_{}", percent(percentile.share)), percentile.distance);
    }
    if let Some(statistics) = &deviation.pooled {
        rows.statistics("pooled", statistics);
    }
    rows.0
}

struct Rows(String);

impl Rows {
    fn push(&mut self, direction: &str, statistic: &str, value: Enclosure) {
        let [lower, upper] = [value.lower(), value.upper()].map(shortest);
        let _ = writeln!(self.0, "{direction},{statistic},{lower},{upper}");
    }

    fn statistics(&mut self, direction: &str, statistics: &Statistics) {
        self.push(direction, "mean", statistics.mean);
        self.push(direction, "rms", statistics.rms);
        for percentile in &statistics.percentiles {
            self.push(direction, &format!("percentile_{}", percent(percentile.share)), percentile.distance);
        }
        if let Some(above) = &statistics.above {
            self.push(direction, &format!("share_above_{}", shortest(above.threshold)), above.share);
        }
    }
}
