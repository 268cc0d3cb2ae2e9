//! The answer for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{counted, point, shortest, vertices_and_faces};
use crate::page::{brief, proven};
use crate::printer::LABEL;
use std::fmt::Write;
use std::path::Path;

/// A row for each operation that did something, with the first places.
pub(super) fn text(certificate: Option<&Path>, answer: &AnswerOf<Files>) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: &str| {
        let _ = writeln!(text, "{LABEL}{label:<10}{LABEL:#}{value}");
    };
    for input in &answer.inputs {
        row("input", &vertices_and_faces(input.vertices, input.faces));
    }
    let found = &answer.report;
    row("result", &vertices_and_faces(found.vertices, found.faces));
    let report = &found.repair;
    let changes = [
        (&report.unreferenced_vertices, "vertex", "in no face dropped"),
        (&report.welded, "vertex", "made one with an earlier vertex"),
        (&report.degenerate_faces, "face", "of area zero dropped"),
        (&report.duplicate_faces, "face", "with the vertices of an earlier face dropped"),
        (&report.split_edges, "edge", "with more than two faces cut apart"),
        (&report.split_vertices, "vertex", "split into one for each fan of faces"),
        (&report.turned_faces, "face", "turned"),
        (&report.non_orientable_components, "component", "with one side only cut open"),
        (&report.opened_edges, "edge", "cut apart for that"),
        (&report.filled_holes, "hole", "filled"),
        (&report.holes_left, "hole", "left, because every way to fill them reuses an edge or has no area"),
    ];
    let mut label = "done";
    for (change, noun, what) in changes.into_iter().filter(|(change, ..)| change.count > 0) {
        let first = change.places.iter().take(3).map(|&place| point(place)).collect::<Vec<_>>().join(", ");
        let more = if change.count > 3 { ", …" } else { "" };
        row(label, &format!("{} {what}, at {first}{more}", counted(change.count, noun)));
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
