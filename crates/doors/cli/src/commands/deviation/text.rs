//! A screenful of the outcome for people: the verdict, both directions beside each other, the worst regions.

use super::bands;
use super::full::{faces, percentage};
use super::parts;
use super::run::{Outcome, directions, percent};
use crate::aligned;
use crate::exit::stopped_by;
use crate::numbers::{few, grouped, point, rounded, time};
use crate::page::{Page, brief};
use pompeiu::hausdorff::deviation::{DirectedBands, DirectedDeviation, Region, Statistics};
use std::time::Duration;

/// Regions that are listed at most.
const REGIONS: usize = 3;

pub(super) fn text(outcome: &Outcome) -> String {
    let deviation = &outcome.deviation;
    let mut page = Page::new();
    if let Some(verdict) = outcome.verdict() {
        page.row("verdict", &verdict.sentence(outcome));
        page.gap();
    }
    page.files(outcome.names, &outcome.a, &outcome.b);
    if let Some(left_out) = &outcome.left_out {
        for (i, (name, left_out)) in outcome.names.into_iter().zip(left_out).enumerate() {
            page.row(if i == 0 { "left out" } else { "" }, &parts::described(name, left_out));
        }
    }
    if let Some(found) = &outcome.alignment {
        page.row("moved", &aligned::verdict(found));
    }
    page.gap();
    let unit = if outcome.unit.is_empty() { String::new() } else { format!(" {}", outcome.unit) };
    page.row("H(A, B)", &format!("{}{unit}   the largest distance", brief(deviation.distance)));
    page.gap();
    both(&mut page, outcome);
    regions(&mut page, outcome);
    let [read, refine] = [outcome.read, sum(outcome, |directed| directed.work.refine)].map(time);
    let search = time(sum(outcome, |directed| directed.work.build + directed.work.search));
    page.row(
        "time",
        &format!("read {read}, search {search}, refine {refine}, total {}", time(outcome.total)),
    );
    page.into_text()
}

/// Both directions beside each other.
fn both(page: &mut Page, outcome: &Outcome) {
    let [a, b] = outcome.names;
    let found = [&outcome.deviation.a_to_b, &outcome.deviation.b_to_a];
    page.columns("", [&format!("{a} to {b}"), &format!("{b} to {a}")]);
    page.columns("", [&format!("missing in {b}"), &format!("invented by {b}")]);
    let mut row = |name: &str, cell: &dyn Fn(&DirectedDeviation) -> String| {
        let [left, right] = found.map(cell);
        page.columns(name, [&left, &right]);
    };
    row("largest", &|directed| brief(directed.distance.distance));
    let mut statistic = |name: &str, cell: &dyn Fn(&Statistics) -> Option<String>| {
        row(name, &|directed| {
            directed.statistics.as_ref().and_then(cell).unwrap_or_else(|| "no area".to_owned())
        });
    };
    statistic("mean", &|statistics| Some(brief(statistics.mean)));
    statistic("rms", &|statistics| Some(brief(statistics.rms)));
    let shares = found.iter().find_map(|directed| directed.statistics.as_ref());
    let shares =
        shares.map_or_else(Vec::new, |statistics| statistics.percentiles.iter().map(|p| p.share).collect());
    for (i, share) in shares.into_iter().enumerate() {
        statistic(&format!("{} %", percent(share)), &|statistics| {
            Some(brief(statistics.percentiles.get(i)?.distance))
        });
    }
    if outcome.threshold.is_some() {
        statistic("beyond", &|statistics| {
            Some(format!("{} of the area", percentage(statistics.above.as_ref()?.share)))
        });
    }
    if let Some(report) = &outcome.bands {
        for (i, class) in bands::names(&report.edges).iter().enumerate() {
            let cell = |found: &DirectedBands| match &found.shares {
                Some(shares) => format!("{} {class}", percentage(shares[i])),
                None => "no area".to_owned(),
            };
            let name = if i == 0 { "bands" } else { "" };
            page.columns(name, [&cell(&report.a_to_b), &cell(&report.b_to_a)]);
        }
    }
    let mut row = |name: &str, cell: &dyn Fn(&DirectedDeviation) -> String| {
        let [left, right] = found.map(cell);
        page.columns(name, [&left, &right]);
    };
    if found.iter().any(|directed| directed.sides.is_some()) {
        row("inside", &|directed| inside(directed).unwrap_or_default());
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
    Some(format!("{inside} of {} vertices", grouped(all as u64)))
}

/// The worst places of both directions, each once.
fn regions(page: &mut Page, outcome: &Outcome) {
    let [a, b] = outcome.names;
    let named = directions(&outcome.deviation).into_iter().zip([[a, b], [b, a]]);
    let mut all: Vec<(&Region, [&str; 2])> = named
        .flat_map(|((_, directed), names)| directed.regions.iter().map(move |region| (region, names)))
        .collect();
    all.sort_by(|(x, _), (y, _)| y.peak.upper().total_cmp(&x.peak.upper()));
    let mut listed: Vec<&Region> = Vec::new();
    for (region, [from, to]) in all {
        if listed.len() == REGIONS || listed.iter().any(|other| is_beside(other, region)) {
            continue;
        }
        listed.push(region);
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

/// Whether a region has its peak where another one lies, up to the distance of both surfaces there: seen from the other surface it
/// is the same place.
fn is_beside(other: &Region, region: &Region) -> bool {
    let reach = other.peak.upper();
    let place = region.witness.from.position;
    (0..3).all(|k| (other.aabb.lower[k] - reach..=other.aabb.upper[k] + reach).contains(&place[k]))
}

fn sum(outcome: &Outcome, part: fn(&DirectedDeviation) -> Duration) -> Duration {
    directions(&outcome.deviation).map(|(_, directed)| part(directed)).iter().sum()
}
