//! The outcome for people. Digits are shown only as far as they are proven.

use super::outcome::{Answer, Outcome};
use super::watch::TraceRow;
use crate::aligned::verdict;
use crate::args::ToleranceKind;
use crate::exit::stopped_by;
use crate::numbers::{grouped, plain, point, shortest, time};
use crate::page::{Page, value};
use pompeiu::hausdorff::{DirectedReport, Direction, Enclosure, StopReason};

pub(super) fn text(outcome: &Outcome) -> String {
    let mut page = Page::new();
    let labels = [("A", outcome.names[0]), ("B", outcome.names[1])]
        .map(|(symbol, name)| if symbol == name { symbol.to_owned() } else { format!("{symbol}, {name}") });
    page.files([&labels[0], &labels[1]], &outcome.a, &outcome.b);
    if let Some(found) = &outcome.alignment {
        page.row("moved", &verdict(found));
    }
    page.gap();
    if let Some((threshold, answer)) = outcome.answer() {
        page.row("answer", &sentence(outcome, threshold, answer));
        page.gap();
    }
    if let (Some(distance), Some(a_to_b), Some(b_to_a)) =
        (outcome.hausdorff(), &outcome.a_to_b, &outcome.b_to_a)
    {
        let origin = if a_to_b.distance.lower() >= b_to_a.distance.upper() {
            "equal to h(A, B)"
        } else if b_to_a.distance.lower() >= a_to_b.distance.upper() {
            "equal to h(B, A)"
        } else {
            "the greater of the two below"
        };
        page.row("H(A, B)", &format!("{}   {origin}", value(distance)));
        page.row("", &proven(distance));
        page.gap();
    }
    if let Some(report) = &outcome.a_to_b {
        directed(&mut page, report, Direction::AToB, outcome);
    }
    if let Some(report) = &outcome.b_to_a {
        directed(&mut page, report, Direction::BToA, outcome);
    }
    if let Some(rows) = &outcome.trace {
        trace(&mut page, rows);
    }
    let [read, build, search, total] =
        [outcome.times.read, outcome.build(), outcome.search(), outcome.times.total].map(time);
    page.row("time", &format!("read {read}, build {build}, search {search}, total {total}"));
    page.into_text()
}

fn sentence(outcome: &Outcome, threshold: f64, answer: Answer) -> String {
    let name = match (&outcome.a_to_b, &outcome.b_to_a) {
        (Some(_), Some(_)) => "H(A, B)",
        (Some(_), None) => "h(A, B)",
        _ => "h(B, A)",
    };
    let threshold = shortest(threshold);
    match answer {
        Answer::Below => format!("{name} is at most {threshold}: proven"),
        Answer::Above => format!("{name} exceeds {threshold}: proven by the points below"),
        Answer::Undecided => format!("undecided whether {name} is at most {threshold}"),
    }
}

fn proven(distance: Enclosure) -> String {
    let [lower, upper] = [distance.lower(), distance.upper()].map(shortest);
    if lower == upper {
        return "proven, with no gap".to_owned();
    }
    format!("proven to lie between {lower} and {upper} (gap {})", gap(distance.gap()))
}

/// A tolerance: powers of ten in full, others to two digits.
fn fraction(tolerance: f64) -> String {
    let shortest = format!("{tolerance:e}");
    if shortest.len() <= 5 { shortest } else { format!("{tolerance:.1e}") }
}

/// A width, to two digits.
fn gap(width: f64) -> String {
    format!("{width:.1e}")
}

fn directed(page: &mut Page, report: &DirectedReport, direction: Direction, outcome: &Outcome) {
    let (name, from, to) = match direction {
        Direction::AToB => ("h(A, B)", "A", "B"),
        Direction::BToA => ("h(B, A)", "B", "A"),
    };
    let witness = &report.witness;
    page.row(name, &format!("{}   how far {from} is from {to}", value(report.distance)));
    page.row("", &proven(report.distance));
    page.row("", &format!("from {from} at {} on face {}", point(witness.from.position), witness.from.face.0));
    page.row("", &format!("to   {to} at {} on face {}", point(witness.to.position), witness.to.face.0));
    let asked = || match outcome.kind {
        ToleranceKind::Diagonal => format!("{} of the diagonal", shortest(outcome.requested)),
        ToleranceKind::Relative => format!("{} of the distance", shortest(outcome.requested)),
        ToleranceKind::Absolute => shortest(outcome.requested),
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
            let fraction = fraction(row.fraction);
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
