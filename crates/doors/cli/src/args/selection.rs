//! What no cut may touch, from a file.

use anyhow::Context;
use clap::Args;
use pompeiu::flatten::CutRequest;
use std::path::{Path as FilePath, PathBuf};

#[derive(Args)]
pub(crate) struct ForbidFile {
    /// Let no cut enter what this text file names, one on each line: v I a vertex, e I J an edge, f I a face
    #[arg(long, value_name = "FILE")]
    forbid_file: Option<PathBuf>,
}

impl ForbidFile {
    /// Adds what the file names to a request.
    pub(crate) fn add_to(&self, request: &mut CutRequest) -> anyhow::Result<()> {
        if let Some(path) = &self.forbid_file {
            let Selection { vertices, edges, faces } = read_selection(path)?;
            request.forbid.extend(vertices);
            request.forbid_edges.extend(edges);
            request.forbid_faces.extend(faces);
        }
        Ok(())
    }
}

/// Vertices, edges and faces that a file names.
#[derive(Debug, Default, PartialEq)]
struct Selection {
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    faces: Vec<u32>,
}

fn read_selection(path: &FilePath) -> anyhow::Result<Selection> {
    crate::files::check_readable(path)?;
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    selection(&text).map_err(|line| {
        let shown = path.display();
        anyhow::anyhow!("{shown}: line {line} is none of `v I`, `e I J` and `f I`; empty lines and lines after # are left out")
    })
}

/// What lines name; the number of the first line that names nothing.
fn selection(text: &str) -> Result<Selection, usize> {
    let mut selection = Selection::default();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let parts: Vec<&str> = line.split_whitespace().collect();
        let index = |text: &str| text.parse::<u32>().map_err(|_| number + 1);
        match parts[..] {
            [] => {}
            ["v", i] => selection.vertices.push(index(i)?),
            ["e", i, j] => selection.edges.push([index(i)?, index(j)?]),
            ["f", i] => selection.faces.push(index(i)?),
            _ => return Err(number + 1),
        }
    }
    Ok(selection)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selections_name_vertices_edges_and_faces() {
        let found = selection("v 3\n# all of it\n\ne 4 5 # one\nf 6").unwrap();
        let expected = Selection { vertices: vec![3], edges: vec![[4, 5]], faces: vec![6] };
        assert_eq!(found, expected);
        for (wrong, line) in [("v", 1), ("v 1\ne 2", 2), ("x 1", 1), ("\n\nv -1", 3)] {
            assert_eq!(selection(wrong), Err(line), "{wrong}");
        }
    }
}
