//! Evidence that does not come from the code: counts of copies, gluing back, brute force, closed forms, real meshes.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod charts;
mod cuts;
mod far;
mod maps;
mod straight;
mod symmetry;

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes;
use pompeiu_core::mesh::subdivide;
use pompeiu_surface::EmbeddedSurface;
use pompeiu_testkit::data;

/// A real mesh, if it is present.
fn real_mesh(name: &str) -> Option<TriMesh> {
    Some(pompeiu_io::read_mesh(data::file(&format!("meshes/{name}"))?).unwrap())
}

fn surface(mesh: &TriMesh) -> EmbeddedSurface {
    EmbeddedSurface::new(mesh).unwrap()
}

/// A surface of this genus with this many boundary loops.
fn zoo(genus: u32, loops: usize) -> TriMesh {
    let closed = match genus {
        0 => shapes::icosphere(1.0, 2).unwrap(),
        1 => shapes::torus(2.0, 0.7, 18, 12).unwrap(),
        holes => subdivide(&shapes::perforated_plate(1.0, holes).unwrap()).unwrap(),
    };
    let (positions, faces) = subdivide(&closed).unwrap().into_parts();
    // The middle parts of faces that lie far apart, which do not meet.
    let apart = faces.len() / 4 / 6;
    let removed: Vec<usize> = (0..loops).map(|k| 4 * apart * k + 3).collect();
    let kept =
        faces.iter().enumerate().filter(|(f, _)| !removed.contains(f)).map(|(_, face)| *face).collect();
    TriMesh::new(positions, kept).unwrap()
}
