//! Pages of one mesh: what it is, and what became of it.

use crate::error::CallError;
use crate::meshes::Loaded;
use pompeiu::core::TriMesh;
use pompeiu::core::request::InfoReport;
use pompeiu::figures::page::{
    Axis, Block, Card, Fact, Layer, Mesh, Page, Paint, Scene, Shape, Space, SpaceId, Text,
};
use pompeiu::hausdorff::Enclosure;

/// A mesh beside the one that it was made of.
pub(crate) struct Changed {
    pub(crate) what: &'static str,
    pub(crate) mesh: TriMesh,
    pub(crate) distance: Option<Enclosure>,
}

fn page(title: String, command: Option<&str>) -> (Page, SpaceId) {
    let mut page = Page::new(title);
    page.command = command.map(str::to_owned);
    env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
    let space = page.add_space(Space::Spatial(Axis::Z));
    (page, space)
}

/// A mesh and what was found of it.
pub(crate) fn described(
    loaded: &Loaded,
    report: &InfoReport,
    command: Option<&str>,
) -> Result<String, CallError> {
    let (mut page, space) = page(loaded.name().to_owned(), command);
    let summary = &report.summary;
    page.subtitle = Text::from(format!("{} vertices, ", summary.vertices)).count(summary.faces, "face");
    let mesh = page.add_mesh(space, Mesh::of(loaded.name(), &loaded.mesh))?;
    let mut scene = Scene::new("surface", space);
    scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Plain, bounds: None }));
    page.add_scene(scene)?;
    page.add_card(Card::new("Measures", vec![Block::Facts(measures(report))]))?;
    page.add_card(Card::new("Defects", vec![defects(report)]))?;
    page.add_card(Card::new("Run", vec![Block::Run]))?;
    Ok(page.html())
}

fn measures(report: &InfoReport) -> Vec<Fact> {
    let (summary, topology) = (&report.summary, &report.summary.connectivity);
    let bounds = &summary.bounding_box;
    let size = [0, 1, 2].map(|k| format!("{}", ((bounds.upper[k] - bounds.lower[k]) as f32)));
    let number = |x: f64| Text::default().number(x, 6);
    let mut facts = vec![
        Fact::new("size", size.join(" × ")),
        Fact::new("diagonal", number(bounds.diagonal())),
        Fact::new("area", number(summary.area)),
        Fact::new(
            "volume",
            summary.volume.map_or_else(|| Text::from("none: the faces do not enclose one"), number),
        ),
        Fact::new("edges", topology.edges.to_string()),
        Fact::new("components", topology.components.to_string()),
        Fact::new("boundary loops", topology.boundary_loops.to_string()),
        Fact::new("Euler characteristic", topology.euler_characteristic.to_string()),
    ];
    facts.extend(topology.genus.map(|genus| Fact::new("genus", genus.to_string())));
    if let Some(file) = &report.file {
        let compressed = if file.compressed { ", compressed" } else { "" };
        facts.insert(0, Fact::new("file", format!("{}{compressed}", file.format)));
    }
    facts
}

fn defects(report: &InfoReport) -> Block {
    let (summary, topology) = (&report.summary, &report.summary.connectivity);
    let intersections = report.self_intersections.as_ref().map_or(0, |found| found.count);
    let all = [
        (summary.degenerate_faces, "degenerate faces", "of area zero"),
        (summary.duplicate_faces, "duplicate faces", "with the vertices of another"),
        (summary.seam_edges, "seam edges", "at the place of another boundary edge; repairing welds them"),
        (summary.unreferenced_vertices, "unreferenced vertices", "in no face"),
        (topology.non_manifold_edges, "non-manifold edges", "in more than two faces"),
        (topology.non_manifold_vertices, "non-manifold vertices", "with more than one fan of faces"),
        (topology.inconsistent_edges, "inconsistent edges", "between faces of opposite orientation"),
        (intersections, "intersections", "pairs of faces that intersect"),
    ];
    let found = all.into_iter().filter(|(count, ..)| *count > 0);
    let facts: Vec<Fact> =
        found.map(|(count, name, what)| Fact::new(name, format!("{count}, {what}"))).collect();
    if facts.is_empty() { Block::Text("No defects were found.".into()) } else { Block::Facts(facts) }
}

/// A mesh before and after.
pub(crate) fn changed(
    loaded: &Loaded,
    changed: &Changed,
    command: Option<&str>,
) -> Result<String, CallError> {
    let (mut page, space) = page(format!("{} {}", loaded.name(), changed.what), command);
    page.add_before_and_after(space, [&loaded.mesh, &changed.mesh])?;
    let mut facts = vec![
        Fact::new(
            "vertices",
            format!("{} before, {} after", loaded.mesh.positions().len(), changed.mesh.positions().len()),
        ),
        Fact::new(
            "faces",
            format!("{} before, {} after", loaded.mesh.faces().len(), changed.mesh.faces().len()),
        ),
    ];
    if let Some(distance) = changed.distance {
        let text = Text::default().number(distance.lower(), 6).text(" to ").number(distance.upper(), 6);
        facts.push(Fact::new("distance from the input, proven", text));
    }
    page.add_card(Card::new("Result", vec![Block::Facts(facts)]))?;
    page.add_card(Card::new("Run", vec![Block::Run]))?;
    Ok(page.html())
}
