//! Files, folders and patterns on the command line.

use pompeiu::io::Format;
use pompeiu::matching::Unusable;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Mesh files to look at, each once, and what led to none.
pub(crate) struct Inputs {
    pub(crate) paths: Vec<PathBuf>,
    pub(crate) problems: Vec<Unusable>,
}

/// The files that arguments name: files themselves, the mesh files in folders, by their suffixes and names in order, and what
/// patterns match, which may be folders again. What exists is taken by its name even where that looks like a pattern.
pub(crate) fn expand(arguments: &[PathBuf], recursive: bool) -> Inputs {
    let mut found = Inputs { paths: Vec::new(), problems: Vec::new() };
    for argument in arguments {
        let pattern = argument.to_str().filter(|text| text.contains(['*', '?', '[']) && !argument.exists());
        match pattern {
            Some(pattern) => found.matching(pattern, recursive),
            None => found.named(argument, recursive),
        }
    }
    let mut met = BTreeSet::new();
    found.paths.retain(|path| met.insert(path.clone()));
    found
}

impl Inputs {
    fn problem(&mut self, path: &Path, message: &impl ToString) {
        self.problems.push(Unusable { path: path.display().to_string(), message: message.to_string() });
    }

    fn matching(&mut self, pattern: &str, recursive: bool) {
        let paths = match glob::glob(pattern) {
            Ok(paths) => paths,
            Err(error) => return self.problem(Path::new(pattern), &format!("is no pattern: {}", error.msg)),
        };
        let before = self.paths.len() + self.problems.len();
        for path in paths {
            match path {
                Ok(path) => self.named(&path, recursive),
                Err(error) => self.problem(error.path(), &error.error()),
            }
        }
        if before == self.paths.len() + self.problems.len() {
            self.problem(Path::new(pattern), &"matches no file");
        }
    }

    fn named(&mut self, path: &Path, recursive: bool) {
        if !path.is_dir() {
            return self.paths.push(path.to_owned());
        }
        let before = self.paths.len() + self.problems.len();
        self.folder(path, recursive);
        if before == self.paths.len() + self.problems.len() {
            let deeper = if recursive { "" } else { "; --recursive looks into the folders in it" };
            self.problem(path, &format!("holds no file with the suffix of a mesh{deeper}"));
        }
    }

    fn folder(&mut self, path: &Path, recursive: bool) {
        let entries = std::fs::read_dir(path).and_then(Iterator::collect::<std::io::Result<Vec<_>>>);
        let mut entries = match entries {
            Ok(entries) => entries,
            Err(error) => return self.problem(path, &error),
        };
        entries.sort_by_key(std::fs::DirEntry::file_name);
        for entry in entries {
            let path = entry.path();
            // Links to folders are not followed, so that no circle of them is.
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if is_folder && recursive {
                self.folder(&path, recursive);
            } else if !path.is_dir() && Format::from_path(&path).is_some() {
                self.paths.push(path);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(inputs: &Inputs, root: &Path) -> Vec<String> {
        let shown = |path: &PathBuf| path.strip_prefix(root).unwrap().display().to_string();
        inputs.paths.iter().map(shown).collect()
    }

    #[test]
    fn folders_patterns_and_names_are_expanded_once_and_in_order() {
        let folder = tempfile::TempDir::new().unwrap();
        let root = folder.path();
        std::fs::create_dir_all(root.join("deep/er.obj")).unwrap();
        for name in ["b.obj", "a.ply.gz", "notes.txt", "[x].obj", "deep/c.stl", "deep/er.obj/d.off"] {
            std::fs::write(root.join(name), "").unwrap();
        }
        let of = |names: &[&str], recursive| {
            let arguments: Vec<PathBuf> = names.iter().map(|name| root.join(name)).collect();
            let inputs = expand(&arguments, recursive);
            (shown(&inputs, root), inputs.problems.len())
        };
        let names = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(of(&[""], false), (names(&["[x].obj", "a.ply.gz", "b.obj"]), 0));
        let all = ["[x].obj", "a.ply.gz", "b.obj", "deep/c.stl", "deep/er.obj/d.off"];
        assert_eq!(of(&[""], true), (names(&all), 0));
        assert_eq!(
            of(&["*.obj", "b.obj", "notes.txt"], false),
            (names(&["[x].obj", "b.obj", "notes.txt"]), 0)
        );
        assert_eq!(of(&["[x].obj", "[ab].obj"], false), (names(&["[x].obj", "b.obj"]), 0));
        assert_eq!(
            of(&["**/*.stl", "missing.obj", "*.vtp"], false),
            (names(&["deep/c.stl", "missing.obj"]), 1)
        );
        assert_eq!(of(&["a[.obj"], false), (Vec::new(), 1));
        std::fs::create_dir(root.join("empty")).unwrap();
        assert_eq!(of(&["empty"], true), (Vec::new(), 1));
    }
}
