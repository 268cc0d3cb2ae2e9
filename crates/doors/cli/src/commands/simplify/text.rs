//! The answer for people.

use super::{Files, place};
use crate::door::AnswerOf;
use crate::numbers::{counted, grouped, pairs_that_intersect, shortest, time};
use crate::page::{brief, proven};
use crate::printer::LABEL;
use pompeiu::remesh::{Kept, Refusals};
use std::fmt::Write;
use std::path::Path;

/// A row for each quantity, the verdict first.
pub(super) fn text(output: &Path, certificate: Option<&Path>, answer: &AnswerOf<Files>) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: String| {
        let _ = writeln!(text, "{LABEL}{label:<10}{LABEL:#}{value}");
    };
    let found = &answer.report;
    let level = &found.level;
    let before = answer.inputs.first().map_or(0, |input| input.faces);
    let share = 100.0 * level.faces as f64 / before as f64;
    let faces = |n: usize| counted(n, "face");
    row("faces", format!("{} of {}, {share:.3} %", grouped(level.faces as u64), grouped(before as u64)));
    let report = &level.distance;
    let bound = match level.within {
        Some(within) => format!(", proven to be at most {}", shortest(within)),
        None => String::new(),
    };
    row("H(A, B)", brief(report.distance) + &bound);
    row("", proven(report.distance));
    row("h(A, B)", brief(report.a_to_b.distance) + ", from the input to the result");
    row("h(B, A)", brief(report.b_to_a.distance) + ", from the result to the input");
    if let Some(count) = level.intersections {
        row("intersect", pairs_that_intersect(count));
    }
    if let Some(kept) = kept(&found.kept) {
        row("kept", kept);
    }
    for (i, level) in found.finer.iter().enumerate() {
        let path = place(output, i + 1);
        let distance = brief(level.distance.distance);
        let label = if i == 0 { "finer" } else { "" };
        row(label, format!("{}, H(A, B) {distance}: {}", faces(level.faces), path.display()));
    }
    if let (Some(refusals), Some(asked)) = (&level.refusals, answer.request.faces) {
        let asked = asked.of(before);
        let are = if asked == 1 { "is" } else { "are" };
        row("refused", format!("{} {are} not reached: {}", faces(asked), why(refusals)));
    } else if found.stop.is_early() {
        row("stopped", format!("early ({}): fewer faces may do", found.stop.name()));
    }
    let [collapse, distance, total] =
        [found.timing.collapse, found.timing.distance, answer.timing.total].map(time);
    row("time", format!("collapse {collapse}, distance {distance}, total {total}"));
    if let Some((path, answer)) = certificate.zip(found.certificate.as_ref()) {
        text += &crate::certificate::text(path, answer);
    }
    text
}

/// Why no further edge is collapsed.
fn why(found: &Refusals) -> String {
    let least = counted(found.least_faces, "face");
    let of_each = [
        (found.topology, "would change the topology"),
        (found.features, "would change a curve that is kept"),
        (found.normals, "would turn a face over"),
        (found.intersections, "would make faces intersect"),
    ];
    let reasons: Vec<String> = of_each
        .into_iter()
        .filter(|(edges, _)| *edges > 0)
        .map(|(edges, what)| format!("{} {what}", grouped(edges as u64)))
        .collect();
    let edges = counted(found.edges, "edge");
    format!("of {edges} {}; this topology needs at least {least}", reasons.join(", "))
}

/// What is kept of the look of the input; none if there was nothing.
fn kept(kept: &Kept) -> Option<String> {
    let mut parts = Vec::new();
    if kept.texture {
        parts.push("texture coordinates".to_owned());
    }
    match kept.materials {
        0 => {}
        n => parts.push(counted(n, "material")),
    }
    if kept.colors {
        parts.push("colours".into());
    }
    match kept.seam_edges {
        0 => {}
        1 => parts.push("1 seam edge as a curve".into()),
        n => parts.push(format!("{} seam edges as curves", grouped(n as u64))),
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}
