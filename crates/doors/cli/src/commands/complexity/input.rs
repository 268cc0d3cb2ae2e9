//! The shapes in folders, and rankings in files.

use crate::many::Problem;
use anyhow::{Context, bail};
use pompeiu::complexity::Shape;
use pompeiu::planar::silhouette::SilhouetteOptions;
use pompeiu::planar::{is_shape, read_region};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// The files of shapes that arguments name: files themselves, and those in folders by their suffixes, in order.
pub(super) fn expand(arguments: &[PathBuf]) -> (Vec<PathBuf>, Vec<Problem>) {
    let (mut paths, mut problems) = (Vec::new(), Vec::new());
    for argument in arguments {
        let mut problem =
            |message: String| problems.push(Problem { path: argument.display().to_string(), message });
        if !argument.is_dir() {
            paths.push(argument.clone());
            continue;
        }
        let entries = std::fs::read_dir(argument).and_then(|entries| {
            entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>()
        });
        match entries {
            Ok(mut found) => {
                found.retain(|path| path.is_file() && is_shape(path));
                found.sort();
                if found.is_empty() {
                    problem(
                        "holds no picture (PNG, JPEG, GIF, BMP), drawing (SVG, DXF) or list of points"
                            .to_owned(),
                    );
                }
                paths.extend(found);
            }
            Err(error) => problem(error.to_string()),
        }
    }
    (paths, problems)
}

/// Reads the shapes, each under its path; what cannot be used is a problem.
pub(super) fn read(paths: &[PathBuf], options: &SilhouetteOptions) -> (Vec<Shape>, Vec<Problem>) {
    let one = |path: &PathBuf| {
        let file = path.display().to_string();
        match read_region(path, options) {
            Ok(region) => Ok(Shape { file, outline: region.outer }),
            Err(error) => Err(Problem { path: file, message: error.to_string() }),
        }
    };
    let found: Vec<Result<Shape, Problem>> = paths.par_iter().map(one).collect();
    let (mut shapes, mut problems) = (Vec::new(), Vec::new());
    for result in found {
        match result {
            Ok(shape) => shapes.push(shape),
            Err(problem) => problems.push(problem),
        }
    }
    (shapes, problems)
}

/// Names with places: lines `name,place`, a first line of heads left out.
pub(super) fn ranking(path: &Path) -> anyhow::Result<Vec<(String, f64)>> {
    let shown = path.display();
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_path(path)
        .with_context(|| shown.to_string())?;
    let mut found: Vec<(String, f64)> = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.with_context(|| shown.to_string())?;
        let line = index + 1;
        let (Some(name), Some(place)) = (record.get(0), record.get(1)) else {
            bail!("{shown}: line {line} has one column; expected a name and a place");
        };
        match place.parse::<f64>() {
            Ok(place) if place.is_finite() => {
                if found.iter().any(|(known, _)| known == name) {
                    bail!("{shown}: line {line}: `{name}` is there twice");
                }
                found.push((name.to_owned(), place));
            }
            _ if index == 0 => (),
            _ => bail!("{shown}: line {line}: `{place}` is not a number"),
        }
    }
    Ok(found)
}
