//! The two meshes of a comparison, by position or by role.

use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Meshes {
    /// A mesh file: the surface as it should be
    #[arg(value_name = "A", required_unless_present = "model")]
    a: Option<PathBuf>,
    /// Another mesh file, in the same unit: the surface as it is
    #[arg(value_name = "B", required_unless_present = "scan")]
    b: Option<PathBuf>,
    /// A, named: the surface as it should be. Needs --scan
    #[arg(long, value_name = "FILE", requires = "scan", conflicts_with_all = ["a", "b"])]
    model: Option<PathBuf>,
    /// B, named: the surface as it is. Needs --model
    #[arg(long, value_name = "FILE", requires = "model", conflicts_with_all = ["a", "b"])]
    scan: Option<PathBuf>,
}

/// What files with a surface as it is are often called, and those with a surface as it should be.
const SCAN_WORDS: [&str; 4] = ["scan", "measured", "as-built", "actual"];
const MODEL_WORDS: [&str; 4] = ["model", "cad", "nominal", "design"];

impl Meshes {
    /// The files A and B.
    pub(crate) fn paths(&self) -> [&Path; 2] {
        [first(self.model.as_ref(), self.a.as_ref()), first(self.scan.as_ref(), self.b.as_ref())]
    }

    /// What the two are called in answers.
    pub(crate) fn names(&self) -> [&'static str; 2] {
        if self.model.is_some() { ["model", "scan"] } else { ["A", "B"] }
    }

    /// Whether the names of the files say that they were given in the other order.
    pub(crate) fn look_swapped(&self) -> bool {
        let [a, b] = self.paths();
        self.model.is_none()
            && says(a, &SCAN_WORDS)
            && !says(a, &MODEL_WORDS)
            && says(b, &MODEL_WORDS)
            && !says(b, &SCAN_WORDS)
    }
}

/// The parser refuses a command line that has neither.
fn first<'p>(named: Option<&'p PathBuf>, placed: Option<&'p PathBuf>) -> &'p Path {
    named.or(placed).map_or(Path::new(""), PathBuf::as_path)
}

fn says(path: &Path, words: &[&str]) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    words.iter().any(|word| name.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_are_read_from_names_only_where_both_say_so() {
        let look = |a: &str, b: &str| {
            let [a, b] = [a, b].map(|path| Some(PathBuf::from(path)));
            Meshes { a, b, model: None, scan: None }.look_swapped()
        };
        assert!(look("in/Scan7.ply", "part_CAD.stl"));
        assert!(!look("part_CAD.stl", "in/Scan7.ply"));
        assert!(
            !look("scan.ply", "part.stl")
                && !look("a.ply", "model.obj")
                && !look("scan-of-model.ply", "model.obj")
        );
    }
}
