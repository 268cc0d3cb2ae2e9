//! The outcome for people.

use super::run::{Outcome, within};
use crate::numbers::{grouped, pairs_that_intersect, shortest, time};
use crate::page::value;
use crate::printer::LABEL;
use std::fmt::Write;
use std::time::Duration;

/// A row for each quantity, the verdict first.
pub(super) fn text(outcome: &Outcome) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: String| {
        let _ = writeln!(text, "{LABEL}{label:<10}{LABEL:#}{value}");
    };
    let (output, found) = outcome.asked();
    let [before, after] = [outcome.input.faces, output.faces];
    let share = 100.0 * after as f64 / before as f64;
    let faces = |n: usize| grouped(n as u64);
    row("faces", format!("{} of {}, {share:.3} %", faces(after), faces(before)));
    let report = &found.distance;
    let proven = match within(found) {
        Some(within) => format!(", proven to be at most {}", shortest(within)),
        None => String::new(),
    };
    row("H(A, B)", value(report.distance) + &proven);
    row("h(A, B)", value(report.a_to_b.distance) + ", from the input to the result");
    row("h(B, A)", value(report.b_to_a.distance) + ", from the result to the input");
    if let Some(count) = found.intersections {
        row("intersect", pairs_that_intersect(count));
    }
    if let Some(kept) = outcome.kept.text() {
        row("kept", kept);
    }
    let mut label = "finer";
    for (file, level) in &outcome.levels[1..] {
        row(
            label,
            format!("{} faces, H(A, B) {}: {}", faces(file.faces), value(level.distance.distance), file.path),
        );
        label = "";
    }
    if found.stop.is_early() {
        row("stopped", format!("early ({}): fewer faces may do", found.stop.name()));
    }
    let timings = outcome.levels.iter().map(|(_, level)| level.timing);
    let (collapse, distance) =
        timings.fold(Default::default(), |(c, d): (Duration, Duration), t| (c + t.collapse, d + t.distance));
    row(
        "time",
        format!("collapse {}, distance {}, total {}", time(collapse), time(distance), time(outcome.total)),
    );
    text
}
