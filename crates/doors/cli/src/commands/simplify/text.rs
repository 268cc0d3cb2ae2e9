//! The outcome for people.

use super::run::Outcome;
use crate::numbers::{agreed, between, grouped, shortest, time};
use crate::printer::LABEL;
use pompeiu::hausdorff::Enclosure;
use std::fmt::Write;

/// A row for each quantity, the verdict first.
pub(super) fn text(outcome: &Outcome) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: String| {
        let _ = writeln!(text, "{LABEL}{label:<10}{LABEL:#}{value}");
    };
    let [before, after] = [outcome.input.faces, outcome.output.faces];
    let share = 100.0 * after as f64 / before as f64;
    let faces = |n: usize| grouped(n as u64);
    row("faces", format!("{} of {}, {share:.3} %", faces(after), faces(before)));
    let report = &outcome.found.distance;
    let proven = match outcome.within {
        Some(within) => format!(", proven to be at most {}", shortest(within)),
        None => String::new(),
    };
    row("H(A, B)", shown(report.distance) + &proven);
    row("h(A, B)", shown(report.a_to_b.distance) + ", from the input to the result");
    row("h(B, A)", shown(report.b_to_a.distance) + ", from the result to the input");
    if outcome.found.stop.is_early() {
        row("stopped", format!("early ({}): fewer faces may do", outcome.found.stop.name()));
    }
    let timing = outcome.found.timing;
    row(
        "time",
        format!(
            "collapse {}, distance {}, total {}",
            time(timing.collapse),
            time(timing.distance),
            time(outcome.total)
        ),
    );
    text
}

fn shown(distance: Enclosure) -> String {
    let (lower, upper) = (distance.lower(), distance.upper());
    agreed(lower, upper).unwrap_or_else(|| between(lower, upper))
}
