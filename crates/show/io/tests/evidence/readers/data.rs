//! Real meshes, which are not part of the project.

use std::path::PathBuf;

/// The meshes with a suffix, when there are any: below the folder of real meshes.
#[allow(clippy::print_stdout, reason = "a test that skips what is not there says so")]
pub(crate) fn real_meshes(suffix: &str) -> Vec<PathBuf> {
    let root = pompeiu_testkit::data::folder();
    let mut folders = vec![root.clone()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|s| s == suffix) {
                found.push(path);
            }
        }
    }
    found.sort();
    if found.is_empty() {
        println!("skipped: no {suffix} files below {}", root.display());
    } else {
        println!("{} {suffix} files below {}", found.len(), root.display());
    }
    found
}
