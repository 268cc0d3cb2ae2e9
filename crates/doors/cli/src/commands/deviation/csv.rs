//! The statistics as comma-separated values: one row for each number, with both ends of what is proven of it.

use super::{directions, percent};
use crate::numbers::shortest;
use pompeiu::hausdorff::deviation::Statistics;
use pompeiu::hausdorff::{DeviationReport, Enclosure};
use std::fmt::Write;

pub(super) fn csv(report: &DeviationReport) -> String {
    let deviation = &report.deviation;
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
    if let Some(bands) = &report.bands {
        for (name, found) in [("a_to_b", &bands.a_to_b), ("b_to_a", &bands.b_to_a)] {
            rows.ends(name, "lowest", [found.lowest.lower, found.lowest.upper]);
            rows.ends(name, "highest", [found.highest.lower, found.highest.upper]);
            for (share, class) in found.shares.iter().flatten().zip(bands.class_names()) {
                rows.push(name, &format!("share {class}").replace(' ', "_"), *share);
            }
        }
    }
    rows.0
}

struct Rows(String);

impl Rows {
    fn push(&mut self, direction: &str, statistic: &str, value: Enclosure) {
        self.ends(direction, statistic, [value.lower(), value.upper()]);
    }

    fn ends(&mut self, direction: &str, statistic: &str, ends: [f64; 2]) {
        let [lower, upper] = ends.map(shortest);
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
