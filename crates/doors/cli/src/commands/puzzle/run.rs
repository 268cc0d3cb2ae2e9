//! Runs the command.

use super::args::Puzzle as Args;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::run::{Control, Limits, Progress, StopReason};
use pompeiu::planar::silhouette::SilhouetteOptions;
use pompeiu::planar::{Outline, read_region};
use pompeiu::puzzle::{
    LikeOptions, Motion, PieceDrawing, PieceName, PieceShape, Print, Puzzle, PuzzleOptions, PuzzleReport,
    cuts_dxf, cuts_svg, kerf, make, make_like, motion_png, motion_svg, page, pieces_dxf, pieces_png,
    pieces_svg, report, report_like, take_apart,
};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What was made, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) puzzle: Puzzle,
    pub(super) report: PuzzleReport,
    /// How it comes apart, where it does and somebody wants to see it.
    pub(super) motion: Option<Motion>,
    /// Why placing pieces ended before it was done.
    pub(super) stop: Option<StopReason>,
}

/// A kind of drawing.
#[derive(Clone, Copy)]
enum Drawing {
    Svg,
    Dxf,
    Png,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let outputs: Vec<&Path> = [&args.output, &args.cuts, &args.motion, &args.report]
        .into_iter()
        .flatten()
        .map(PathBuf::as_path)
        .collect();
    let shape_file = args.piece.as_deref().filter(|name| PieceName::named(name).is_none()).map(Path::new);
    let inputs: Vec<&Path> = args
        .outline
        .iter()
        .chain(&args.image)
        .chain(&args.whimsy)
        .map(PathBuf::as_path)
        .chain(shape_file)
        .collect();
    files::check_places(outputs, &inputs)?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let output_kind = kind(args.output.as_deref(), &[Drawing::Svg, Drawing::Dxf, Drawing::Png])?;
    let cuts_kind = kind(args.cuts.as_deref(), &[Drawing::Svg, Drawing::Dxf])?;
    let motion_kind = kind(args.motion.as_deref(), &[Drawing::Svg, Drawing::Png])?;
    let print = args
        .image
        .as_deref()
        .map(|path| printed(path).with_context(|| path.display().to_string()))
        .transpose()?;
    let shown = || args.outline.as_ref().map_or_else(String::new, |path| path.display().to_string());
    let outline = match &args.outline {
        Some(path) => Some(whole(path).with_context(shown)?),
        None => None,
    };
    let whimsies = args.whimsy.iter().map(|path| whole(path).with_context(|| path.display().to_string()));
    let options = PuzzleOptions {
        outline,
        whimsies: whimsies.collect::<anyhow::Result<_>>()?,
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
            free_outline: args.free_outline,
            limits: args.limits.after(started.elapsed()),
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
    if args.kerf > 0.0 {
        let limits = Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() };
        report.kerf = Some(kerf(&puzzle, args.kerf, &Control::start(&limits)));
    }
    let is_shown = args.motion.is_some() || args.report.is_some();
    let motion = if is_shown { take_apart(&puzzle, &report.found) } else { None };
    let drawing = PieceDrawing { pull: args.pull, kerf: args.kerf, print: print.as_ref() };
    if let (Some(path), Some(kind)) = (&args.output, output_kind) {
        let content = match kind {
            Drawing::Svg => pieces_svg(&puzzle, &drawing).into_bytes(),
            Drawing::Dxf => pieces_dxf(&puzzle, &drawing).into_bytes(),
            Drawing::Png => png(path, pieces_png(&puzzle, print.as_ref()))?,
        };
        files::write_whole(path, &content, printer)?;
    }
    if let (Some(path), Some(kind)) = (&args.cuts, cuts_kind) {
        let text = match kind {
            Drawing::Dxf => cuts_dxf(&puzzle, args.kerf),
            _ => cuts_svg(&puzzle, args.kerf),
        };
        files::write_whole(path, text.as_bytes(), printer)?;
    }
    if let (Some(path), Some(kind)) = (&args.motion, motion_kind) {
        match &motion {
            Some(motion) => {
                let content = match kind {
                    Drawing::Png => png(path, motion_png(&puzzle, motion))?,
                    _ => motion_svg(&puzzle, motion).into_bytes(),
                };
                files::write_whole(path, &content, printer)?;
            }
            None => printer.warning(format_args!(
                "{}: not written, for no motion takes the puzzle apart",
                path.display()
            )),
        }
    }
    if let Some(path) = &args.report {
        let title = format!("Puzzle of {} pieces", puzzle.pieces());
        let text = page(&puzzle, &report, motion.as_ref(), print.as_ref(), &title);
        files::write_whole(path, text.as_bytes(), printer)?;
    }
    report.timing.total = started.elapsed();
    report.timing.make = made.saturating_sub(report.timing.lock + report.timing.depth);
    let outcome = Outcome { puzzle, report, motion, stop };
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

/// The picture in a file.
fn printed(path: &Path) -> anyhow::Result<Print> {
    files::check_readable(path)?;
    Ok(Print::read(&std::fs::read(path)?)?)
}

fn png(path: &Path, found: Result<Vec<u8>, String>) -> anyhow::Result<Vec<u8>> {
    found.map_err(|why| anyhow::anyhow!("{}: {why}", path.display()))
}

impl Drawing {
    fn suffix(self) -> &'static str {
        match self {
            Self::Svg => ".svg",
            Self::Dxf => ".dxf",
            Self::Png => ".png",
        }
    }
}

/// The kind of drawing that a suffix names, one of those that may be.
fn kind(path: Option<&Path>, kinds: &[Drawing]) -> anyhow::Result<Option<Drawing>> {
    let Some(path) = path else { return Ok(None) };
    let is = |kind: &&Drawing| {
        path.extension().is_some_and(|found| found.eq_ignore_ascii_case(&kind.suffix()[1..]))
    };
    let Some(kind) = kinds.iter().find(is) else {
        let names: Vec<&str> = kinds.iter().map(|kind| kind.suffix()).collect();
        bail!("{}: puzzles are written as {}", path.display(), names.join(" or "))
    };
    Ok(Some(*kind))
}
