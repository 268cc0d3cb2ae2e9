//! The answer for people. Digits are shown only as far as they are proven.

use super::Files;
use crate::aligned::verdict;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{grouped, plain, point, shortest, time};
use crate::page::{Page, brief, described, proven};
use pompeiu::hausdorff::{
    AskedTolerance, Comparison, DirectedDistance, Direction, DistanceReport, StopReason, ThresholdAnswer,
    ToleranceKind, TraceRow,
};
use std::path::Path;

pub(super) fn text(names: [&str; 2], certificate: Option<&Path>, answer: &AnswerOf<Files>) -> String {
    let mut page = Page::new();
    let report = &answer.report.distance;
    let labels = [("A", names[0]), ("B", names[1])]
        .map(|(symbol, name)| if symbol == name { symbol.to_owned() } else { format!("{symbol}, {name}") });
    for (label, input) in labels.iter().zip(&answer.inputs) {
        page.row(label, &described(input));
    }
    if let Some(found) = &answer.report.alignment {
        page.row("moved", &verdict(found));
    }
    page.gap();
    if let Some(threshold) = report.threshold {
        page.row("answer", &sentence(report, threshold));
        page.gap();
    }
    if let (Some(distance), Some(a_to_b), Some(b_to_a)) = (report.hausdorff, &report.a_to_b, &report.b_to_a) {
        let origin = if a_to_b.distance.lower() >= b_to_a.distance.upper() {
            "equal to h(A, B)"
        } else if b_to_a.distance.lower() >= a_to_b.distance.upper() {
            "equal to h(B, A)"
        } else {
            "the greater of the two below"
        };
        page.row("H(A, B)", &format!("{}   {origin}", brief(distance)));
        page.row("", &proven(distance));
        page.gap();
    }
    if let Some(one) = &report.a_to_b {
        directed(&mut page, one, Direction::AToB, report.tolerance);
    }
    if let Some(one) = &report.b_to_a {
        directed(&mut page, one, Direction::BToA, report.tolerance);
    }
    if let Some(rows) = &report.trace {
        trace(&mut page, rows);
    }
    if let Some((path, answer)) = certificate.zip(report.certificate.as_ref()) {
        crate::certificate::rows(&mut page, path, answer);
        page.gap();
    }
    let [read, build, search, total] =
        [answer.timing.read, report.timing.build, report.timing.search, answer.timing.total].map(time);
    page.row("time", &format!("read {read}, build {build}, search {search}, total {total}"));
    page.into_text()
}

fn sentence(report: &DistanceReport, threshold: ThresholdAnswer) -> String {
    let name = match (&report.a_to_b, &report.b_to_a) {
        (Some(_), Some(_)) => "H(A, B)",
        (Some(_), None) => "h(A, B)",
        _ => "h(B, A)",
    };
    let ThresholdAnswer { value, answer } = threshold;
    let threshold = shortest(value);
    match answer {
        Comparison::Below => format!("{name} is at most {threshold}: proven"),
        Comparison::Above => format!("{name} exceeds {threshold}: proven by the points below"),
        Comparison::Undecided => format!("undecided whether {name} is at most {threshold}"),
    }
}

/// A tolerance: powers of ten in full, others to two digits.
fn fraction(tolerance: f64) -> String {
    let shortest = format!("{tolerance:e}");
    if shortest.len() <= 5 { shortest } else { format!("{tolerance:.1e}") }
}

fn directed(page: &mut Page, report: &DirectedDistance, direction: Direction, tolerance: AskedTolerance) {
    let witness = &report.witness;
    let (name, [from, to], [start, end]) = match direction {
        Direction::AToB => ("h(A, B)", ["A", "B"], [witness.a, witness.b]),
        Direction::BToA => ("h(B, A)", ["B", "A"], [witness.b, witness.a]),
    };
    page.row(name, &format!("{}   how far {from} is from {to}", brief(report.distance)));
    page.row("", &proven(report.distance));
    page.row("", &format!("from {from} at {} on face {}", point(start.position), start.face.0));
    page.row("", &format!("to   {to} at {} on face {}", point(end.position), end.face.0));
    let asked = || match tolerance.kind {
        ToleranceKind::Diagonal => format!("{} of the diagonal", shortest(tolerance.requested)),
        ToleranceKind::Relative => format!("{} of the distance", shortest(tolerance.requested)),
        ToleranceKind::Absolute => shortest(tolerance.requested),
    };
    let stop = match report.stop {
        StopReason::Tolerance | StopReason::Threshold => None,
        StopReason::Rounding => Some(format!("double precision, short of the tolerance {}", asked())),
        reason => Some(stopped_by(reason).to_owned()),
    };
    if let Some(stop) = stop {
        page.row("", &format!("stopped by {stop}"));
    }
    page.gap();
}

fn trace(page: &mut Page, rows: &[TraceRow]) {
    for (direction, name) in [(Direction::AToB, "A to B"), (Direction::BToA, "B to A")] {
        let mut rows = rows.iter().filter(|row| row.direction == direction).peekable();
        if rows.peek().is_none() {
            continue;
        }
        page.row(
            name,
            &format!(
                "{:>9}  {:>19}  {:>19}  {:>11}  {:>13}  {:>9}",
                "tolerance", "lower", "upper", "pieces left", "distances", "time"
            ),
        );
        for row in rows {
            let [lower, upper] = [row.lower, row.upper].map(plain);
            let pieces = row.pieces.map_or_else(|| "?".to_owned(), |pieces| grouped(pieces as u64));
            let (distances, elapsed) = (grouped(row.distances), time(row.elapsed));
            let fraction = fraction(row.tolerance);
            page.row(
                "",
                &format!(
                    "{fraction:>9}  {lower:>19}  {upper:>19}  {pieces:>11}  {distances:>13}  {elapsed:>9}"
                ),
            );
        }
        page.gap();
    }
}
