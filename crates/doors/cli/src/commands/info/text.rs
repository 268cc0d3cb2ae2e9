//! The summary for people.

use crate::numbers::{counted, grouped, plain, point, six};
use crate::printer::LABEL;
use pompeiu::core::request::{InfoReport, IntersectingFaces};
use std::fmt::Write;
use std::path::Path;

/// A row for each quantity.
pub(super) fn text(path: &Path, report: &InfoReport) -> String {
    let InfoReport { file, summary, self_intersections } = report;
    let (bounds, topology) = (summary.bounding_box, summary.connectivity);
    let number = |n: usize| grouped(n as u64);
    let size = [0, 1, 2].map(|k| plain(bounds.upper[k] - bounds.lower[k]));
    let genus = match topology.genus {
        Some(genus) => number(genus),
        None if topology.edges == 0 => "none: no face has three different vertices".to_owned(),
        None if !topology.orientable => "none: the surface cannot be oriented".to_owned(),
        None => "none: the surface is not a manifold".to_owned(),
    };
    let volume = match summary.volume {
        Some(volume) => measure(volume),
        None if topology.boundary_edges > 0 => "none: the surface has a boundary".to_owned(),
        None if topology.inconsistent_edges > 0 => "none: faces of opposite orientation meet".to_owned(),
        None => "none: the faces do not enclose one".to_owned(),
    };
    let (format, compressed) = file
        .as_ref()
        .map_or(("", ""), |file| (file.format.as_str(), if file.compressed { ", compressed" } else { "" }));
    let rows = [
        ("file", format!("{} ({format}{compressed})", path.display())),
        ("vertices", number(summary.vertices)),
        ("edges", number(topology.edges)),
        ("faces", number(summary.faces)),
        ("bounding box", format!("{} to {}", point(bounds.lower), point(bounds.upper))),
        ("size", format!("{}, diagonal {}", size.join(" × "), six(bounds.diagonal()))),
        ("area", measure(summary.area)),
        ("volume", volume),
        ("components", number(topology.components)),
        ("boundary loops", number(topology.boundary_loops)),
        ("Euler characteristic", topology.euler_characteristic.to_string()),
        ("genus", genus),
    ];
    let oddities = [
        (summary.degenerate_faces, "degenerate face", "area zero"),
        (summary.duplicate_faces, "duplicate face", "the vertices of another"),
        (summary.seam_edges, "seam edge", "at the place of another boundary edge; pompeiu repair welds them"),
        (summary.unreferenced_vertices, "unreferenced vertex", "in no face"),
        (topology.non_manifold_edges, "non-manifold edge", "in more than two faces"),
        (topology.non_manifold_vertices, "non-manifold vertex", "more than one fan of faces"),
        (topology.inconsistent_edges, "inconsistent edge", "between faces of opposite orientation"),
    ];
    let mut text = String::new();
    let mut row = |label: &str, value: &str| {
        let _ = writeln!(text, "{LABEL}{label:<22}{LABEL:#}{value}");
    };
    for (label, value) in rows {
        row(label, &value);
    }
    let mut label = "oddities";
    for (count, name, meaning) in oddities.into_iter().filter(|oddity| oddity.0 > 0) {
        row(label, &format!("{} ({meaning})", counted(count, name)));
        label = "";
    }
    if label == "oddities" {
        row(label, "none");
    }
    if let Some(found) = self_intersections {
        row("self-intersections", &pairs(found));
        if found.touching > 0 {
            let count = grouped(found.touching as u64);
            row("", &format!("{count} more touch where different vertices are at one position"));
        }
    }
    text
}

/// How many pairs of faces intersect, and where the first ones do.
fn pairs(found: &IntersectingFaces) -> String {
    let count = found.count;
    if count == 0 {
        return "none".to_owned();
    }
    let at_least = if found.complete { "" } else { "at least " };
    let noun = if count == 1 { "pair" } else { "pairs" };
    let first: Vec<String> = found.first.iter().take(3).map(|pair| point(pair.place)).collect();
    let more = if count > 3 { ", …" } else { "" };
    format!("{at_least}{} {noun} of faces, at {}{more}", grouped(count as u64), first.join(", "))
}

/// An area or a volume, which may overflow where lengths do not.
fn measure(x: f64) -> String {
    if x.is_finite() { six(x) } else { "beyond the range of double precision".to_owned() }
}
