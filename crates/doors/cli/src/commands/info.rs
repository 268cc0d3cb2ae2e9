//! `pompeiu info`.

use crate::args::Info;
use crate::exit::Exit;
use crate::files;
use crate::numbers::{grouped, plain, point};
use crate::printer::{LABEL, Printer};
use pompeiu::core::MeshSummary;
use pompeiu::io::ReadMesh;
use serde::Serialize;
use std::fmt::Write;

pub(crate) fn run(args: &Info, printer: &Printer) -> anyhow::Result<Exit> {
    let read = files::read(&args.file)?;
    let summary = MeshSummary::of(&read.mesh);
    files::warn_of_changes(&args.file, &read, printer);
    let path = args.file.display().to_string();
    Printer::answer(&if args.json {
        serde_json::to_string(&Report::new(path, &read, &summary))? + "\n"
    } else {
        text(&path, &read, &summary)
    })?;
    Ok(Exit::Done)
}

/// The summary as JSON. Lengths are in the unit of the file; what does not apply, or overflows, is null.
#[derive(Serialize)]
struct Report {
    path: String,
    format: String,
    compressed: bool,
    vertices: usize,
    faces: usize,
    edges: usize,
    bounding_box: BoundingBox,
    area: f64,
    volume: Option<f64>,
    components: usize,
    boundary_loops: usize,
    euler_characteristic: isize,
    genus: Option<usize>,
    orientable: bool,
    degenerate_faces: usize,
    duplicate_faces: usize,
    unreferenced_vertices: usize,
    boundary_edges: usize,
    non_manifold_edges: usize,
    non_manifold_vertices: usize,
    inconsistent_edges: usize,
    polygons_triangulated: u64,
    faces_dropped: u64,
}

#[derive(Serialize)]
struct BoundingBox {
    lower: [f64; 3],
    upper: [f64; 3],
    diagonal: f64,
}

impl Report {
    fn new(path: String, read: &ReadMesh, summary: &MeshSummary) -> Self {
        let (bounds, topology) = (summary.bounding_box, summary.connectivity);
        Self {
            path,
            format: read.format.to_string(),
            compressed: read.compressed,
            vertices: summary.vertices,
            faces: summary.faces,
            edges: topology.edges,
            bounding_box: BoundingBox {
                lower: bounds.lower,
                upper: bounds.upper,
                diagonal: bounds.diagonal(),
            },
            area: summary.area,
            volume: summary.volume,
            components: topology.components,
            boundary_loops: topology.boundary_loops,
            euler_characteristic: topology.euler_characteristic,
            genus: topology.genus,
            orientable: topology.orientable,
            degenerate_faces: summary.degenerate_faces,
            duplicate_faces: summary.duplicate_faces,
            unreferenced_vertices: summary.unreferenced_vertices,
            boundary_edges: topology.boundary_edges,
            non_manifold_edges: topology.non_manifold_edges,
            non_manifold_vertices: topology.non_manifold_vertices,
            inconsistent_edges: topology.inconsistent_edges,
            polygons_triangulated: read.polygons_triangulated,
            faces_dropped: read.faces_dropped,
        }
    }
}

/// The summary for people.
fn text(path: &str, read: &ReadMesh, summary: &MeshSummary) -> String {
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
    let compressed = if read.compressed { ", compressed" } else { "" };
    let rows = [
        ("file", format!("{path} ({}{compressed})", read.format)),
        ("vertices", number(summary.vertices)),
        ("edges", number(topology.edges)),
        ("faces", number(summary.faces)),
        ("bounding box", format!("{} to {}", point(bounds.lower), point(bounds.upper))),
        ("size", format!("{}, diagonal {}", size.join(" × "), plain(bounds.diagonal()))),
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
        row(label, &format!("{} {} ({meaning})", number(count), counted(count, name)));
        label = "";
    }
    if label == "oddities" {
        row(label, "none");
    }
    text
}

/// An area or a volume, which may overflow where lengths do not.
fn measure(x: f64) -> String {
    if x.is_finite() { plain(x) } else { "beyond the range of double precision".to_owned() }
}

/// A noun in the number that goes with a count.
fn counted(count: usize, noun: &str) -> String {
    match (count, noun.strip_suffix("vertex")) {
        (1, _) => noun.to_owned(),
        (_, Some(stem)) => format!("{stem}vertices"),
        _ => format!("{noun}s"),
    }
}
