//! The outcome for people.

use super::args::Files;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{counted, few, grouped, time, vertices_and_faces};
use crate::page::Page;
use pompeiu::contact::ContactReport;
use pompeiu::core::request::Report;
use std::time::Duration;

/// The part of the greatest momentum or of the weight below which a component is shown as 0.
const NEGLIGIBLE: f64 = 1e-9;

/// The end first, then a row for each quantity.
pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let mut page = Page::new();
    let (done, asked) = (report.steps.len(), report.asked);
    let end = report.steps.last().map_or(0.0, |last| last.time);
    let steps = counted(done, "step");
    page.row("result", &format!("time {} after {steps}", few(end)));
    if let Some(failure) = &report.failure {
        page.row("ended", failure);
    } else if done < asked {
        page.row("", &format!("stopped early by {}", stopped_by(report.stop())));
    }
    page.row("certified", &report.certificate.sentence());
    page.row(
        "scene",
        &format!(
            "{}: {}, {}, {}",
            report.scene,
            counted(report.bodies, "body"),
            vertices_and_faces(report.vertices, report.faces),
            counted(report.tetrahedra, "tetrahedron")
        ),
    );
    measured(report, &mut page);
    let milliseconds = |ms: f64| time(Duration::from_secs_f64(ms.max(0.0) / 1e3));
    let timing = &report.timing;
    page.row(
        "time",
        &format!(
            "search {}, collision detection {}, Newton {}, line search {}, exact test {}, total {}",
            milliseconds(timing.search),
            milliseconds(timing.collision_detection),
            milliseconds(timing.newton),
            milliseconds(timing.line_search),
            milliseconds(timing.exact_test),
            time(answer.timing.total)
        ),
    );
    page.into_text()
}

fn measured(report: &ContactReport, page: &mut Page) {
    let Some(last) = report.steps.last() else { return };
    let most = report.steps.iter().map(|step| step.pairs).max().unwrap_or(0);
    let gap = match report.least_gap() {
        Some(gap) => format!("{}, below {} surfaces push each other", few(gap), few(report.scheme.distance)),
        None => "no surfaces came close".to_owned(),
    };
    page.row("least gap", &gap);
    let moving: usize = report.steps.iter().map(|step| step.moving_pairs).sum();
    page.row(
        "work",
        &format!(
            "{}, {} in collision detection, at most {} in contact",
            counted(report.iterations(), "Newton step"),
            counted(moving, "pair"),
            grouped(most as u64)
        ),
    );
    // What is left by rounding is 0.
    let largest = |v: [f64; 3]| v.iter().fold(0.0_f64, |m, x| if x.abs() > m { x.abs() } else { m });
    let momenta =
        report.steps.iter().map(|step| largest(step.momentum)).chain([largest(report.start.momentum)]);
    let greatest = momenta.fold(0.0_f64, |m, x| if x > m { x } else { m });
    let vector = |v: [f64; 3], scale: f64| {
        v.map(|x| few(if x.abs() > NEGLIGIBLE * scale { x } else { 0.0 })).join(", ")
    };
    if report.weight != [0.0; 3] {
        page.row(
            "forces",
            &format!(
                "obstacles push ({}), weight ({})",
                vector(last.support, largest(report.weight)),
                vector(report.weight, 0.0)
            ),
        );
    }
    page.row(
        "momentum",
        &format!("({}), was ({})", vector(last.momentum, greatest), vector(report.start.momentum, greatest)),
    );
    page.row(
        "energy",
        &format!(
            "kinetic {}, elastic {}, gravity {}",
            few(last.kinetic_energy),
            few(last.elastic_energy),
            few(last.potential_energy)
        ),
    );
}
