//! The outcome for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{counted, few, grouped, time};
use crate::page::Page;
use pompeiu::coupling::CoupleReport;
use pompeiu::coupling::scenario::RunReport;
use std::fmt::Write;

pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let windows = report.windows;
    if answer.request.compare {
        return table(report);
    }
    let mut page = Page::new();
    let run = &report.runs[0];
    let done = run.windows.len();
    let verdict = if done == windows {
        format!("AGREED in all {}", counted(windows, "window"))
    } else {
        format!("AGREED in {} of {}", grouped(done as u64), counted(windows, "window"))
    };
    let mut text = verdict + "\n\n";
    page.row("scene", &report.kind);
    page.row("scheme", &run.scheme);
    if let Some(mean) = run.mean_solves() {
        let most = run.windows.iter().map(|window| window.solves).max().unwrap_or(0);
        page.row("solves", &format!("{} a window, at most {most}, the last one verifies", few(mean)));
    }
    let damped = run.windows.iter().filter(|window| window.damping < 1.0).count();
    if damped > 0 {
        page.row("damped", &format!("{}, where the model alone failed", counted(damped, "window")));
    }
    if let Some(added_mass) = run.added_mass {
        page.row("stability", &added_mass.to_string());
    }
    if let Some(constant) = run.windows.last().and_then(|window| window.pressure_constant) {
        page.row(
            "enclosed",
            &format!("the constant of the pressure is chosen in each window, {} in the last", few(constant)),
        );
    }
    if let Some(distance) = run.from_monolithic {
        page.row(
            "reference",
            &format!(
                "{} from both solved at once (monolithic), relative to the greatest value",
                few(distance)
            ),
        );
    }
    if let Some(failure) = &run.failure {
        page.row("ended", failure);
    }
    page.row("time", &time(answer.timing.total));
    text += &page.into_text();
    text
}

/// A line for each scheme.
fn table(report: &CoupleReport) -> String {
    let widest = report.runs.iter().map(|run| run.scheme.len()).max().unwrap_or(0).max(6);
    let mut text =
        format!("{:<widest$}  {:>7}  {:>6}  {:>10}  ended\n", "scheme", "windows", "solves", "monolithic");
    for run in &report.runs {
        let mean = run.mean_solves().map_or(String::new(), |mean| format!("{mean:.2}"));
        let distance = run.from_monolithic.map_or(String::new(), few);
        let _ = writeln!(
            text,
            "{:<widest$}  {:>7}  {mean:>6}  {distance:>10}  {}",
            run.scheme,
            run.windows.len(),
            ended(run)
        );
    }
    let greatest = report.runs.iter().filter_map(|run| run.added_mass);
    if let Some(added_mass) = greatest.max_by(|a, b| a.number.total_cmp(&b.number)) {
        let _ = writeln!(text, "\n{added_mass}");
    }
    text
}

fn ended(run: &RunReport) -> String {
    match &run.failure {
        None => "all windows solved".to_owned(),
        Some(failure) if failure.starts_with("interrupted") => failure.clone(),
        Some(_) => format!("fails in window {}", run.windows.len() + 1),
    }
}
