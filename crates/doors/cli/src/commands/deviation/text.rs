//! A screenful of the outcome for people: the verdict, both directions beside each other, the worst regions.

use super::full::faces;
use super::{Files, directions, percent, percentage};
use crate::aligned;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{counted, few, grouped, point, rounded};
use crate::page::{Page, brief, compared};
use pompeiu::hausdorff::DeviationReport;
use pompeiu::hausdorff::deviation::{DirectedBands, DirectedDeviation, Region, SignedStatistics, Statistics};

/// Regions that are listed at most.
const REGIONS: usize = 3;

pub(super) fn text(names: [&str; 2], answer: &AnswerOf<Files>) -> String {
    let report = &answer.report.measured;
    let mut page = Page::new();
    let unit = &answer.request.deviation.measures.unit;
    compared(&mut page, names, &answer.inputs, report, unit);
    if let Some(found) = &answer.report.alignment {
        page.row("moved", &aligned::verdict(found));
    }
    page.gap();
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    page.row("H(A, B)", &format!("{}{unit}   the largest distance", brief(report.deviation.distance)));
    page.gap();
    both(&mut page, names, report);
    regions(&mut page, names, report);
    page.into_text()
}

/// Both directions beside each other.
fn both(page: &mut Page, [a, b]: [&str; 2], report: &DeviationReport) {
    let found = [&report.deviation.a_to_b, &report.deviation.b_to_a];
    page.columns("", [&format!("{a} to {b}"), &format!("{b} to {a}")]);
    page.columns("", [&format!("missing on {b}"), &format!("excess on {b}")]);
    let mut row = |name: &str, cell: &dyn Fn(&DirectedDeviation) -> String| {
        let [left, right] = found.map(cell);
        page.columns(name, [&left, &right]);
    };
    row("largest", &|directed| brief(directed.distance.distance));
    let of = |cell: &dyn Fn(&Statistics) -> Option<String>, directed: &DirectedDeviation| {
        directed.statistics.as_ref().and_then(cell).unwrap_or_else(|| "no area".to_owned())
    };
    row("mean", &|directed| of(&|statistics| Some(brief(statistics.mean)), directed));
    row("rms", &|directed| of(&|statistics| Some(brief(statistics.rms)), directed));
    let mut signed = |name: &str, cell: &dyn Fn(&SignedStatistics) -> String| {
        if found.iter().any(|directed| directed.signed.is_some()) {
            row(name, &|directed| directed.signed.as_ref().map_or_else(|| "unknown".to_owned(), cell));
        }
    };
    signed("signed", &|signed| signed.mean.shown());
    signed("lowest", &|signed| signed.lowest.shown());
    signed("highest", &|signed| signed.highest.shown());
    signed("std dev", &|signed| brief(signed.standard_deviation));
    let mut statistic = |name: &str, cell: &dyn Fn(&Statistics) -> Option<String>| {
        row(name, &|directed| of(cell, directed));
    };
    let shares = found.iter().find_map(|directed| directed.statistics.as_ref());
    let shares =
        shares.map_or_else(Vec::new, |statistics| statistics.percentiles.iter().map(|p| p.share).collect());
    for (i, share) in shares.into_iter().enumerate() {
        statistic(&format!("{} %", percent(share)), &|statistics| {
            Some(brief(statistics.percentiles.get(i)?.distance))
        });
    }
    if report.threshold.is_some() {
        statistic("beyond", &|statistics| {
            Some(format!("{} of the area", percentage(statistics.above.as_ref()?.share)))
        });
    }
    if let Some(bands) = &report.bands {
        for (i, class) in bands.class_names().iter().enumerate() {
            let cell = |found: &DirectedBands| match &found.shares {
                Some(shares) => format!("{} {class}", percentage(shares[i])),
                None => "no area".to_owned(),
            };
            let name = if i == 0 { "bands" } else { "" };
            page.columns(name, [&cell(&bands.a_to_b), &cell(&bands.b_to_a)]);
        }
    }
    let mut row = |name: &str, cell: &dyn Fn(&DirectedDeviation) -> String| {
        let [left, right] = found.map(cell);
        page.columns(name, [&left, &right]);
    };
    if found.iter().any(|directed| directed.sides.is_some()) {
        row("inside", &|directed| inside(directed).unwrap_or_default());
    }
    for (to, directed) in [b, a].into_iter().zip(found) {
        let is_asked = directed.sides.is_some() && report.bands.is_none() && !directed.stop.is_early();
        if is_asked && directed.signed.is_none() && directed.statistics.is_some() {
            page.row("", &format!("{to} is not closed and oriented: there are no signed statistics"));
        }
    }
    for (name, directed) in [a, b].into_iter().zip(found) {
        if directed.stop.is_early() {
            let stop = stopped_by(directed.stop);
            page.row("", &format!("from {name}: stopped by {stop}; intervals are wider than asked"));
        }
    }
    page.gap();
}

fn inside(directed: &DirectedDeviation) -> Option<String> {
    let inside = grouped(directed.sides.as_ref()?.vertices_inside() as u64);
    let all = directed.vertices.iter().filter(|distance| !distance.is_nan()).count();
    Some(format!("{inside} of {}", counted(all, "vertex")))
}

/// The worst places of both directions, each once.
fn regions(page: &mut Page, [a, b]: [&str; 2], report: &DeviationReport) {
    let named = directions(&report.deviation).into_iter().zip([[a, b], [b, a]]);
    let mut all: Vec<(&Region, [&str; 2])> = named
        .flat_map(|((_, directed), names)| directed.regions.iter().map(move |region| (region, names)))
        .collect();
    all.sort_by(|(x, _), (y, _)| y.peak.upper().total_cmp(&x.peak.upper()));
    let mut listed: Vec<(&Region, &str)> = Vec::new();
    for (region, [from, to]) in all {
        let is_listed = |&(other, of): &(&Region, &str)| of != from && is_beside(other, region);
        if listed.len() == REGIONS || listed.iter().any(is_listed) {
            continue;
        }
        listed.push((region, from));
        let place = point(region.witness.from.position.map(rounded));
        let name = if listed.len() == 1 { "worst" } else { "" };
        let (n, peak, count, area) = (listed.len(), brief(region.peak), faces(region), few(region.area));
        page.row(name, &format!("{n}. {peak} at {place}, {from} to {to}; {count}, area {area}"));
    }
    if !listed.is_empty() {
        page.row("", "--full shows more of it, --report FILE.html all");
        page.gap();
    }
}

/// Whether a region has its peak where one of the other surface lies, up to the distance of both surfaces at the peak: seen from the
/// other surface it is the same place. Regions of one surface are different places.
fn is_beside(other: &Region, region: &Region) -> bool {
    let reach = region.peak.upper();
    let place = region.witness.from.position;
    (0..3).all(|k| (other.aabb.lower[k] - reach..=other.aabb.upper[k] + reach).contains(&place[k]))
}
