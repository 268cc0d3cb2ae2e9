//! Evidence that does not come from the code: random operations, inverses, proven distances.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod carried;
mod operations;
mod remeshing;
mod simplification;

use pompeiu_core::TriMesh;
use pompeiu_testkit::data;

/// A real mesh, if it is there.
fn real_mesh(name: &str) -> Option<TriMesh> {
    Some(pompeiu_io::read_mesh(data::file(&format!("meshes/{name}"))?).unwrap())
}
