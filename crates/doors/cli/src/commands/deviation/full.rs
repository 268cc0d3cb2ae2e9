//! The whole outcome for people. Digits are shown only as far as they are proven.

use super::{Files, percent, percentage};
use crate::aligned::verdict as alignment;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{counted, few, grouped, point, rounded, shortest};
use crate::page::{Page, compared, value};
use pompeiu::hausdorff::deviation::{DirectedDeviation, Percentile, Region, Statistics};
use pompeiu::hausdorff::{DeviationReport, Direction};

pub(super) fn text([a, b]: [&str; 2], answer: &AnswerOf<Files>) -> String {
    let report = &answer.report.measured;
    let deviation = &report.deviation;
    let mut page = Page::new();
    let unit = &answer.request.deviation.measures.unit;
    compared(&mut page, [a, b], &answer.inputs, report, unit);
    if let Some(found) = &answer.report.alignment {
        page.row("moved", &alignment(found));
    }
    page.gap();
    let origin = match (deviation.a_to_b.distance.distance, deviation.b_to_a.distance.distance) {
        (there, back) if there.lower() >= back.upper() => format!("the largest distance, from {a} to {b}"),
        (there, back) if back.lower() >= there.upper() => format!("the largest distance, from {b} to {a}"),
        _ => "the largest distance".to_owned(),
    };
    page.row("H(A, B)", &format!("{}   {origin}", value(deviation.distance)));
    page.gap();
    directed(&mut page, report, &deviation.a_to_b, [a, b], &format!("what is missing in {b}"));
    directed(&mut page, report, &deviation.b_to_a, [b, a], &format!("what {b} has in excess"));
    if let (Some(greater), Some(pooled)) = (&deviation.greater_percentiles, &deviation.pooled) {
        page.row("both", "by area; the greater of the two directions | pooled over both surfaces");
        page.row("  mean", &format!("| {}", value(pooled.mean)));
        page.row("  rms", &format!("| {}", value(pooled.rms)));
        for (greater, pooled) in greater.iter().zip(&pooled.percentiles) {
            page.row(&label(greater), &format!("{} | {}", value(greater.distance), value(pooled.distance)));
        }
        page.gap();
    }
    page.into_text()
}

fn directed(
    page: &mut Page,
    report: &DeviationReport,
    directed: &DirectedDeviation,
    [from, to]: [&str; 2],
    meaning: &str,
) {
    page.row(&format!("{from} to {to}"), &format!("  how far {from} is from {to}: {meaning}"));
    let witness = &directed.distance.witness.from;
    let at = format!("at {} on face {}", point(witness.position), witness.face.0);
    page.row("  largest", &format!("{} {at}", value(directed.distance.distance)));
    match &directed.statistics {
        Some(found) => {
            statistics(page, found);
            if let Some(found) = &directed.signed {
                page.row("  signed", &format!("mean {}; negative is inside {to}", found.mean.shown()));
                page.row("", &format!("from {} to {}", found.lowest.shown(), found.highest.shown()));
                page.row("  std dev", &value(found.standard_deviation));
            }
        }
        None => page.row("", "no face has an area to take a mean over"),
    }
    if let Some(bands) = &report.bands {
        let found = if directed.direction == Direction::AToB { &bands.a_to_b } else { &bands.b_to_a };
        let extremes = [found.lowest, found.highest].map(|extreme| extreme.shown());
        page.row("  signed", &format!("from {} to {}", extremes[0], extremes[1]));
        for (share, class) in found.shares.iter().flatten().zip(bands.class_names()) {
            page.row("  band", &format!("{} of the area {class}", percentage(*share)));
        }
        if !found.closed {
            page.row(
                "",
                &format!("{to} is not closed: beside its boundary, which side is inside is a choice"),
            );
        }
    }
    if let Some(sides) = &directed.sides {
        let inside = grouped(sides.vertices_inside() as u64);
        let all = directed.vertices.iter().filter(|distance| !distance.is_nan()).count();
        page.row("  inside", &format!("{inside} of {}", counted(all, "vertex")));
        if sides.of_sheet {
            page.row("", &format!("{to} is a sheet: what lies behind its faces counts as inside"));
        }
    }
    regions(page, "  regions", &directed.regions);
    if let Some(threshold) = report.threshold {
        let name = format!("  > {}", shortest(threshold));
        if directed.beyond_threshold.is_empty() {
            page.row(&name, "no region");
        }
        regions(page, &name, &directed.beyond_threshold);
    }
    if directed.stop.is_early() {
        let stop = stopped_by(directed.stop);
        page.row("", &format!("stopped by {stop}: intervals are wider than asked"));
    }
    page.gap();
}

fn statistics(page: &mut Page, statistics: &Statistics) {
    page.row("  mean", &value(statistics.mean));
    page.row("  rms", &value(statistics.rms));
    for percentile in &statistics.percentiles {
        page.row(&label(percentile), &value(percentile.distance));
    }
    if let Some(above) = &statistics.above {
        let share = percentage(above.share);
        page.row("  above", &format!("{share} of the area is farther than {}", shortest(above.threshold)));
    }
}

fn label(percentile: &Percentile) -> String {
    format!("  {} %", percent(percentile.share))
}

/// How many faces a region has.
pub(super) fn faces(region: &Region) -> String {
    counted(region.faces.len(), "face")
}

fn regions(page: &mut Page, name: &str, regions: &[Region]) {
    for (i, region) in regions.iter().enumerate() {
        let [low, high] = [region.aabb.lower, region.aabb.upper];
        let size = [0, 1, 2].map(|k| few(high[k] - low[k])).join(" × ");
        page.row(
            if i == 0 { name } else { "" },
            &format!(
                "{}. {} at {}; {size}, area {}, {}",
                i + 1,
                value(region.peak),
                point(region.witness.from.position.map(rounded)),
                few(region.area),
                faces(region)
            ),
        );
    }
}
