//! Runs the command.

use super::args::Puzzle as Args;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::run::{Limits, Progress, StopReason};
use pompeiu::planar::silhouette::SilhouetteOptions;
use pompeiu::planar::{Outline, read_region};
use pompeiu::puzzle::{
    LikeOptions, PieceName, PieceShape, Puzzle, PuzzleOptions, PuzzleReport, cuts_dxf, cuts_svg, make,
    make_like, page, pieces_dxf, pieces_svg, report, report_like,
};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What was made, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) puzzle: Puzzle,
    pub(super) report: PuzzleReport,
    /// Why placing pieces ended before it was done.
    pub(super) stop: Option<StopReason>,
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
    let shape_file = args.piece.as_deref().filter(|name| PieceName::named(name).is_none()).map(Path::new);
    let inputs: Vec<&Path> = args.outline.iter().map(PathBuf::as_path).chain(shape_file).collect();
    files::check_places(outputs, &inputs)?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let [output, cuts] = [&args.output, &args.cuts];
    let (output_kind, cuts_kind) = (kind(output.as_deref())?, kind(cuts.as_deref())?);
    let shown = || args.outline.as_ref().map_or_else(String::new, |path| path.display().to_string());
    let outline = match &args.outline {
        Some(path) => Some(whole(path).with_context(shown)?),
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
    let piece = match (&args.piece, shape_file) {
        (None, _) => None,
        (Some(_), Some(path)) => {
            let found = whole(path).with_context(|| path.display().to_string())?;
            Some(PieceShape::Outline(found))
        }
        (Some(name), None) => PieceName::named(name).map(PieceShape::Built),
    };
    let (puzzle, mut report, stop) = if let Some(shape) = piece {
        let wait = Wait::new(printer);
        let watch = |progress: &Progress<'_>| {
            wait.progress(progress);
            interrupt::flow()
        };
        let like = LikeOptions {
            shape,
            method: args.method(),
            mirrors: !args.no_mirrors,
            limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
            progress: Some(&watch),
        };
        let made = make_like(&options, &like)?;
        let report = report_like(&made);
        (made.puzzle, report, made.stop)
    } else {
        let puzzle = match args.outline {
            Some(_) => make(&options).with_context(shown)?,
            None => make(&options)?,
        };
        let report = report(&puzzle);
        (puzzle, report, None)
    };
    let made = started.elapsed();
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
    report.timing.total = started.elapsed();
    report.timing.make = made.saturating_sub(report.timing.lock + report.timing.depth);
    let outcome = Outcome { puzzle, report, stop };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if outcome.stop.is_some() { Exit::Undecided } else { Exit::Done })
}

/// The outline in a file, without holes.
fn whole(path: &Path) -> anyhow::Result<Outline> {
    let region = read_region(path, &SilhouetteOptions::default())?;
    if !region.holes.is_empty() {
        bail!(
            "the shape has {} holes; fill them, for neither a puzzle nor a piece can have any",
            region.holes.len()
        );
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
