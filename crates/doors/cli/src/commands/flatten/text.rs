//! The answer for people.

use super::Files;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{counted, grouped, shortest, time};
use crate::page::Page;
use pompeiu::core::run::StopReason;
use pompeiu::flatten::{Charts, FlattenOptions, PartReport};

/// The verdict first, then a row for each quantity.
pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let number = |n: usize| grouped(n as u64);
    let mut page = Page::new();
    let verdict = if report.is_one_to_one() { "yes" } else { "no" };
    page.row(
        "result",
        &format!(
            "one-to-one: {verdict}, {} flipped, {} overlapping of {}",
            number(report.flipped),
            number(report.overlapping),
            counted(report.parts.iter().map(|part| part.faces).sum(), "face")
        ),
    );
    if report.stop == StopReason::Steps {
        let request = &answer.request;
        let target = match request.charts {
            Charts::Auto => FlattenOptions::DISTORTION,
            Charts::Components | Charts::Count(_) => request.target,
        };
        let target = shortest(request.max_distortion.unwrap_or(target));
        page.row(
            "",
            &format!(
                "the energy of {target} asked for was not reached; allow more cuts (--most-cuts), or several charts (--max-distortion {target})"
            ),
        );
    } else if report.stop.is_early() {
        page.row("", &format!("stopped early by {}", stopped_by(report.stop)));
    }
    page.row("charts", &number(report.charts));
    let cut = &report.cut;
    page.row(
        "cut",
        &format!(
            "{} of length {}, {:.2} of the square root of the area ({})",
            counted(cut.edges, "edge"),
            shortest(cut.length),
            cut.relative_length,
            cut.strategy
        ),
    );
    let mean = |part: &PartReport| part.distortion.symmetric_dirichlet.mean;
    let worst = report.parts.iter().max_by(|a, b| mean(a).total_cmp(&mean(b)));
    if let Some(worst) = worst.filter(|_| report.parts.len() > 1) {
        page.row(
            "worst",
            &format!(
                "the chart of face {}: {}, cut of length {}, symmetric Dirichlet energy {:.4}",
                worst.first_face,
                counted(worst.faces, "face"),
                shortest(worst.cut_length),
                mean(worst)
            ),
        );
    }
    let distortion = &report.distortion;
    let energy = distortion.symmetric_dirichlet;
    page.row(
        "lengths",
        &format!(
            "symmetric Dirichlet energy {:.4} on average, at most {:.4} (kept: 4)",
            energy.mean, energy.max
        ),
    );
    page.row(
        "",
        &format!(
            "factor {:.4} on average, at most {:.4}",
            distortion.isometric.mean, distortion.isometric.max
        ),
    );
    page.row(
        "angles",
        &format!(
            "ratio of singular values {:.4} on average, at most {:.4}",
            distortion.angle.mean, distortion.angle.max
        ),
    );
    page.row(
        "areas",
        &format!("factor {:.4} on average, at most {:.4}", distortion.area.mean, distortion.area.max),
    );
    page.row("stretch", &format!("L2 {:.4}, L∞ {:.4}", distortion.stretch_l2, distortion.stretch_linf));
    let timing = report.timing;
    page.row(
        "time",
        &format!(
            "cut {}, factors {}, solves {}, checks {}, total {}",
            time(timing.cut),
            time(timing.factor),
            time(timing.solve),
            time(timing.check),
            time(answer.timing.total)
        ),
    );
    page.into_text()
}
