//! Runs the command.

use super::args::Puzzle as Args;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::planar::silhouette::SilhouetteOptions;
use pompeiu::planar::{Outline, read_region};
use pompeiu::puzzle::{
    Puzzle, PuzzleOptions, PuzzleReport, cuts_dxf, cuts_svg, make, page, pieces_dxf, pieces_svg, report,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What was made, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) puzzle: Puzzle,
    pub(super) report: PuzzleReport,
    /// From the command's start to its answer.
    pub(super) total: Duration,
}

/// A kind of drawing.
#[derive(Clone, Copy)]
enum Drawing {
    Svg,
    Dxf,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let outputs: Vec<&Path> =
        [&args.output, &args.cuts, &args.report].into_iter().flatten().map(PathBuf::as_path).collect();
    let inputs: Vec<&Path> = args.outline.iter().map(PathBuf::as_path).collect();
    files::check_places(outputs, &inputs)?;
    let [output, cuts] = [&args.output, &args.cuts];
    let (output_kind, cuts_kind) = (kind(output.as_deref())?, kind(cuts.as_deref())?);
    let shown = || args.outline.as_ref().map_or_else(String::new, |path| path.display().to_string());
    let outline = match &args.outline {
        Some(path) => Some(outline(path).with_context(shown)?),
        None => None,
    };
    let options = PuzzleOptions {
        outline,
        size: args.size,
        pieces: args.pieces,
        layout: args.layout.into(),
        tab: args.tab.into(),
        seed: args.seed,
    };
    let puzzle = match args.outline {
        Some(_) => make(&options).with_context(shown)?,
        None => make(&options)?,
    };
    let report = report(&puzzle);
    if let (Some(path), Some(kind)) = (output, output_kind) {
        let text = match kind {
            Drawing::Svg => pieces_svg(&puzzle, args.pull),
            Drawing::Dxf => pieces_dxf(&puzzle),
        };
        files::write_whole(path, text.as_bytes(), printer)?;
    }
    if let (Some(path), Some(kind)) = (cuts, cuts_kind) {
        let text = match kind {
            Drawing::Svg => cuts_svg(&puzzle),
            Drawing::Dxf => cuts_dxf(&puzzle),
        };
        files::write_whole(path, text.as_bytes(), printer)?;
    }
    if let Some(path) = &args.report {
        let title = format!("Puzzle of {} pieces", puzzle.pieces());
        files::write_whole(path, page(&puzzle, &report, &title).as_bytes(), printer)?;
    }
    let outcome = Outcome { puzzle, report, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(Exit::Done)
}

/// The outline in a file, without holes.
fn outline(path: &Path) -> anyhow::Result<Outline> {
    let region = read_region(path, &SilhouetteOptions::default())?;
    if !region.holes.is_empty() {
        bail!("the outline has {} holes; fill them, for pieces tile what has none", region.holes.len());
    }
    Ok(region.outer)
}

/// The kind of drawing that a suffix names.
fn kind(path: Option<&Path>) -> anyhow::Result<Option<Drawing>> {
    let Some(path) = path else { return Ok(None) };
    let is = |suffix: &str| path.extension().is_some_and(|found| found.eq_ignore_ascii_case(suffix));
    Ok(Some(if is("svg") {
        Drawing::Svg
    } else if is("dxf") {
        Drawing::Dxf
    } else {
        bail!("{}: puzzles are written as .svg or .dxf", path.display())
    }))
}
