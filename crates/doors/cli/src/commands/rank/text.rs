//! The ranking for people.

use crate::exit::stopped_by;
use crate::numbers::{counted, grouped, shortest, time};
use crate::page::{Page, described, value};
use crate::printer::LABEL;
use pompeiu::core::request::Answer;
use pompeiu::hausdorff::Enclosure;
use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::{BoundKind, Kind, Measure, Row, Work};
use pompeiu::matching::request::{RankReport, RankRequest};
use std::fmt::Write;

/// Ranks for people: one number, or the first and the last.
fn ranks((first, last): (usize, usize)) -> String {
    if first == last {
        grouped(first as u64)
    } else {
        format!("{}–{}", grouped(first as u64), grouped(last as u64))
    }
}

fn enclosure(row: &Row) -> Option<Enclosure> {
    Enclosure::new(row.lower?, row.upper?)
}

pub(super) fn text(answer: &Answer<RankRequest, RankReport>) -> String {
    let mut page = Page::new();
    if let [template, ..] = &answer.inputs[..] {
        page.row("template", &described(template));
    }
    let aligned = match answer.request.align {
        Alignment::None => None,
        Alignment::Centroid => Some("by centroids"),
        Alignment::Scale => Some("by centroids and radii"),
        Alignment::Rigid => Some("rigidly, to the best of several local optima"),
    };
    if let Some(aligned) = aligned {
        page.row("aligned", &format!("{aligned}; distances are those of the targets as moved"));
    }
    page.gap();
    let mut text = page.into_text();
    table(&mut text, answer);
    let mut page = Page::new();
    let open = answer.report.of(Kind::Open).count();
    if open > 0 {
        let (are, stop) = (if open == 1 { "is" } else { "are" }, stopped_by(answer.report.stop));
        page.row("open", &format!("{} {are} not settled: ended by {stop}", grouped(open as u64)));
    }
    let discarded = discarded(&answer.report);
    if discarded.iter().any(|(count, _)| *count > 0) {
        let all: usize = discarded.iter().map(|(count, _)| count).sum();
        let shown = discarded.iter().filter(|(count, _)| *count > 0);
        let reasons: Vec<String> =
            shown.map(|(count, reason)| format!("{} by {reason}", grouped(*count as u64))).collect();
        let are = if all == 1 { "is" } else { "are" };
        page.row("others", &format!("{} {are} proven farther: {}", grouped(all as u64), reasons.join(", ")));
    }
    let failed = answer.report.of(Kind::Failed).count();
    if failed > 0 {
        let file = if failed == 1 { "input" } else { "inputs" };
        page.row("failed", &format!("{} {file} could not be used", grouped(failed as u64)));
    }
    page.row("work", &work(&answer.report.work));
    page.row("time", &format!("total {}", time(answer.timing.total)));
    text + &page.into_text()
}

/// The ranked ones, and as many of the open ones as places were asked for, with columns as wide as they must be.
fn table(text: &mut String, answer: &Answer<RankRequest, RankReport>) {
    let name = match answer.request.direction {
        Measure::Both => "H(template, target)",
        Measure::FromTemplate => "h(template, target)",
        Measure::ToTemplate => "h(target, template)",
    };
    let rows: Vec<[String; 3]> = answer
        .report
        .of(Kind::Ranked)
        .chain(answer.report.of(Kind::Open).take(answer.request.top as usize))
        .map(|row| {
            let distance = enclosure(row).map(value).unwrap_or_default();
            let ranked = row.rank_first.zip(row.rank_last).map(ranks);
            [ranked.unwrap_or_default(), distance, row.path.clone()]
        })
        .collect();
    let width = |column: usize, title: &str| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.fold(title.len(), usize::max)
    };
    let (rank_width, distance_width) = (width(0, "rank"), width(1, name));
    let _ = writeln!(text, "{LABEL}{:>rank_width$}  {name:distance_width$}  target{LABEL:#}", "rank");
    for [rank, distance, target] in &rows {
        let _ = writeln!(text, "{rank:>rank_width$}  {distance:distance_width$}  {target}");
    }
    text.push('\n');
}

/// How many targets were discarded by which kind of bound.
fn discarded(report: &RankReport) -> [(usize, &'static str); 3] {
    [
        (BoundKind::Supports, "their extent"),
        (BoundKind::Probes, "a few of their points"),
        (BoundKind::Search, "a search"),
    ]
    .map(|(kind, name)| {
        let by_kind = report.of(Kind::Discarded).filter(|row| row.discarded_by == Some(kind));
        (by_kind.count(), name)
    })
}

fn work(work: &Work) -> String {
    let mut parts = vec![format!("{} looked at", grouped(work.looks as u64))];
    for (tolerance, count) in work.searches.iter().filter(|(_, count)| *count > 0) {
        parts.push(format!("{} searched to {}", grouped(*count as u64), shortest(tolerance.value())));
    }
    parts.push(counted(work.distances as usize, "distance"));
    parts.join(", ")
}
