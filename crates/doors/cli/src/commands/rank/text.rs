//! The ranking for people.

use super::run::Answer;
use crate::exit::stopped_by;
use crate::numbers::{grouped, shortest, time};
use crate::page::{Page, value};
use crate::printer::LABEL;
use pompeiu::hausdorff::Enclosure;
use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::{Bound, Measure, Report, Standing, Status, Work};
use std::fmt::Write;

/// Ranks for people: one number, or the first and the last.
fn ranks([first, last]: [usize; 2]) -> String {
    if first == last {
        grouped(first as u64)
    } else {
        format!("{}–{}", grouped(first as u64), grouped(last as u64))
    }
}

fn enclosure(standing: &Standing) -> Option<Enclosure> {
    Enclosure::new(standing.lower?, standing.upper?)
}

pub(super) fn text(answer: &Answer) -> String {
    let mut page = Page::new();
    let template = &answer.template;
    let [vertices, faces] = [template.vertices, template.faces].map(|n| grouped(n as u64));
    page.row("template", &format!("{}: {vertices} vertices, {faces} faces", template.path));
    let aligned = match answer.options.alignment {
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
    let open = answer.report.open().count();
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
    let failed = failed(answer).count();
    if failed > 0 {
        let file = if failed == 1 { "input" } else { "inputs" };
        page.row("failed", &format!("{} {file} could not be used", grouped(failed as u64)));
    }
    page.row("work", &work(&answer.report.work));
    page.row("time", &format!("total {}", time(answer.total)));
    text + &page.into_text()
}

/// The ranked ones, and as many of the open ones as places were asked for, with columns as wide as they must be.
fn table(text: &mut String, answer: &Answer) {
    let name = match answer.options.measure {
        Measure::Symmetric => "H(template, target)",
        Measure::TemplateToTarget => "h(template, target)",
        Measure::TargetToTemplate => "h(target, template)",
    };
    let rows: Vec<[String; 3]> = answer
        .report
        .ranked()
        .chain(answer.report.open().take(answer.options.top))
        .map(|standing| {
            let distance = enclosure(standing).map(value).unwrap_or_default();
            [standing.ranks.map(ranks).unwrap_or_default(), distance, standing.name.clone()]
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
fn discarded(report: &Report) -> [(usize, &'static str); 3] {
    let mut counts = [(0, "their extent"), (0, "a few of their points"), (0, "a search")];
    for standing in &report.standings {
        if let Status::Discarded(bound) = standing.status {
            let kind = match bound {
                Bound::Supports => 0,
                Bound::Probes => 1,
                Bound::Search(_) => 2,
            };
            counts[kind].0 += 1;
        }
    }
    counts
}

/// What could not be used, and why.
fn failed(answer: &Answer) -> impl Iterator<Item = (&str, &str)> {
    let targets = answer.report.standings.iter().filter_map(|standing| match &standing.status {
        Status::Failed(message) => Some((standing.name.as_str(), message.as_str())),
        _ => None,
    });
    targets.chain(answer.problems.iter().map(|problem| (problem.path.as_str(), problem.message.as_str())))
}

fn work(work: &Work) -> String {
    let mut parts = vec![format!("{} looked at", grouped(work.looks as u64))];
    for (tolerance, count) in work.searches.iter().filter(|(_, count)| *count > 0) {
        parts.push(format!("{} searched to {}", grouped(*count as u64), shortest(tolerance.value())));
    }
    parts.push(format!("{} distances", grouped(work.distances)));
    parts.join(", ")
}
