//! Evidence that does not come from the code: closed forms, points of the surface, real meshes.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod balls;

use pompeiu_core::TriMesh;
use pompeiu_surface::EmbeddedSurface;
use pompeiu_testkit::data;

/// A real mesh, if it is present.
fn real_mesh(name: &str) -> Option<TriMesh> {
    Some(pompeiu_io::read_mesh(data::file(&format!("meshes/{name}"))?).unwrap())
}

fn surface(mesh: &TriMesh) -> EmbeddedSurface {
    EmbeddedSurface::new(mesh).unwrap()
}
