//! Real meshes, which are not part of the project: tests use them where they are.

use std::path::{Path, PathBuf};

/// Where they are: the folder that `POMPEIU_DATA` names, or `shared/data` beside the repository.
pub fn folder() -> PathBuf {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    std::env::var_os("POMPEIU_DATA").map_or_else(beside, PathBuf::from)
}

/// A file among them, if it is there; says so if not.
#[allow(clippy::print_stdout, reason = "a test that skips what is not there says so")]
pub fn file(name: &str) -> Option<PathBuf> {
    let path = folder().join(name);
    if path.is_file() {
        return Some(path);
    }
    println!("skipped: {name} is not here");
    None
}
