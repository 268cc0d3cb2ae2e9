//! The answer for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{grouped, point, shortest};
use crate::page::{brief, proven};
use crate::printer::LABEL;
use pompeiu::core::mesh::repair::Change;
use std::fmt::Write;
use std::path::Path;

/// A row for each operation that did something, with the first places.
pub(super) fn text(certificate: Option<&Path>, answer: &AnswerOf<Files>) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: &str| {
        let _ = writeln!(text, "{LABEL}{label:<10}{LABEL:#}{value}");
    };
    let counts = |counts: [usize; 2]| {
        let [vertices, faces] = counts.map(|n| grouped(n as u64));
        format!("{vertices} vertices, {faces} faces")
    };
    for input in &answer.inputs {
        row("input", &counts([input.vertices, input.faces]));
    }
    let found = &answer.report;
    row("result", &counts([found.vertices, found.faces]));
    let report = &found.repair;
    let changes: [(&Change, [&str; 2], &str); 11] = [
        (&report.unreferenced_vertices, ["vertex", "vertices"], "in no face dropped"),
        (&report.welded, ["vertex", "vertices"], "made one with an earlier vertex"),
        (&report.degenerate_faces, ["face", "faces"], "of area zero dropped"),
        (&report.duplicate_faces, ["face", "faces"], "with the vertices of an earlier face dropped"),
        (&report.split_edges, ["edge", "edges"], "with more than two faces cut apart"),
        (&report.split_vertices, ["vertex", "vertices"], "split into one for each fan of faces"),
        (&report.turned_faces, ["face", "faces"], "turned"),
        (&report.non_orientable_components, ["component", "components"], "with one side only cut open"),
        (&report.opened_edges, ["edge", "edges"], "cut apart for that"),
        (&report.filled_holes, ["hole", "holes"], "filled"),
        (
            &report.holes_left,
            ["hole", "holes"],
            "left, because every way to fill them reuses an edge or has no area",
        ),
    ];
    let mut label = "done";
    for (change, [one, many], what) in changes.into_iter().filter(|(change, ..)| change.count > 0) {
        let noun = if change.count == 1 { one } else { many };
        let first = change.places.iter().take(3).map(|&place| point(place)).collect::<Vec<_>>().join(", ");
        let more = if change.count > 3 { ", …" } else { "" };
        row(label, &format!("{} {noun} {what}, at {first}{more}", grouped(change.count as u64)));
        label = "";
    }
    if label == "done" {
        row(label, "nothing: the mesh is sound");
    }
    if let Some((within, distance)) = found.within.zip(found.distance) {
        let verdict = if found.written { "proven to be" } else { "not proven to be" };
        row("H(A, B)", &format!("{}, {verdict} at most {}", brief(distance), shortest(within)));
        row("", &proven(distance));
    }
    if let Some((path, answer)) = certificate.zip(found.certificate.as_ref()) {
        text += &crate::certificate::text(path, answer);
    }
    text
}
