//! Evidence that does not come from the code: random operations, inverses, proven distances, closed forms.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and say what they skip")]

mod flow;
mod operations;
mod remeshing;
mod simplification;

use pompeiu_core::TriMesh;
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
