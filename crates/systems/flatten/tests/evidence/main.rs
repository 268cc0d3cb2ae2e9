//! Evidence that does not come from the code: counts of copies, gluing back, brute force, closed forms, real meshes.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and say what they skip")]

mod cuts;
mod maps;

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes;
use pompeiu_core::mesh::subdivide;
use pompeiu_surface::EmbeddedSurface;
use std::path::{Path, PathBuf};

/// A mesh of `../shared/data` beside the repository or of the folder that `POMPEIU_DATA` names, if it is there.
fn real_mesh(name: &str) -> Option<TriMesh> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data");
    let folder = std::env::var_os("POMPEIU_DATA").map_or(beside, PathBuf::from);
    let path = folder.join("meshes").join(name);
    if !path.is_file() {
        println!("left out: there is no {}", path.display());
        return None;
    }
    Some(pompeiu_io::read_mesh(path).unwrap())
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
