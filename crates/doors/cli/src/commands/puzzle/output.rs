//! Drawings of the puzzle.

use super::args::Files;
use crate::files;
use crate::numbers::few;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::puzzle::{
    PieceDrawing, Print, Puzzle, PuzzleAnswer, PuzzleRequest, cuts_dxf, cuts_svg, motion_png, motion_svg,
    page, pieces_dxf, pieces_png, pieces_svg,
};
use std::path::{Path, PathBuf};

/// A kind of drawing.
#[derive(Clone, Copy)]
enum Drawing {
    Svg,
    Dxf,
    Png,
}

/// The files to write, with the kinds that their suffixes name.
pub(super) struct Outputs<'f> {
    files: &'f Files,
    output: Option<(&'f Path, Drawing)>,
    cuts: Option<(&'f Path, Drawing)>,
    motion: Option<(&'f Path, Drawing)>,
}

impl<'f> Outputs<'f> {
    /// Refuses files that cannot be written, or that the request reads.
    pub(super) fn of(files: &'f Files, request: &PuzzleRequest) -> anyhow::Result<Self> {
        if request.layout_on.is_some() {
            check_layout(files)?;
        }
        let outputs = [&files.output, &files.cuts, &files.motion, &files.image, &files.report];
        let inputs: Vec<&Path> = request.files().chain(files.picture.as_deref()).collect();
        files::check_places(outputs.into_iter().flatten().map(PathBuf::as_path), &inputs)?;
        Ok(Self {
            files,
            output: kind(files.output.as_deref(), &[Drawing::Svg, Drawing::Dxf, Drawing::Png])?,
            cuts: kind(files.cuts.as_deref(), &[Drawing::Svg, Drawing::Dxf])?,
            motion: kind(files.motion.as_deref(), &[Drawing::Svg, Drawing::Png])?,
        })
    }

    /// The picture on the pieces.
    pub(super) fn print(&self) -> anyhow::Result<Option<Print>> {
        let Some(path) = &self.files.picture else { return Ok(None) };
        files::check_readable(path)?;
        let read = || anyhow::Ok(Print::read(&std::fs::read(path)?)?);
        read().map(Some).with_context(|| path.display().to_string())
    }

    pub(super) fn write(
        &self,
        found: &PuzzleAnswer,
        kerf: f64,
        print: Option<&Print>,
        printer: &Printer,
    ) -> anyhow::Result<()> {
        let PuzzleAnswer { puzzle, report, motion, .. } = found;
        if let (Some(path), Some(print)) = (&self.files.picture, print) {
            warn_of_proportions(path, print, puzzle, printer);
        }
        if let Some(path) = &self.files.image {
            files::write_whole(path, &png(path, pieces_png(puzzle, print))?, printer)?;
        }
        if let Some((path, kind)) = self.output {
            let drawing =
                PieceDrawing { pull: self.files.pull, packing: report.packing.as_ref(), kerf, print };
            let is_in_place = report.packing.is_none() && self.files.pull <= 0.0;
            if kerf > 0.0 && is_in_place && !matches!(kind, Drawing::Png) {
                printer.note(format_args!(
                    "{}: pieces are in place, and their paths not moved by half of the cut; --layout-on or --pull lays them apart, with the cut",
                    path.display()
                ));
            }
            let content = match kind {
                Drawing::Svg => pieces_svg(puzzle, &drawing).into_bytes(),
                Drawing::Dxf => pieces_dxf(puzzle, &drawing).into_bytes(),
                Drawing::Png => png(path, pieces_png(puzzle, print))?,
            };
            files::write_whole(path, &content, printer)?;
        }
        if let Some((path, kind)) = self.cuts {
            let text = match kind {
                Drawing::Dxf => cuts_dxf(puzzle, kerf),
                _ => cuts_svg(puzzle, kerf),
            };
            files::write_whole(path, text.as_bytes(), printer)?;
        }
        match (self.motion, motion) {
            (Some((path, kind)), Some(motion)) => {
                let content = match kind {
                    Drawing::Png => png(path, motion_png(puzzle, motion))?,
                    _ => motion_svg(puzzle, motion).into_bytes(),
                };
                files::write_whole(path, &content, printer)?;
            }
            (Some((path, _)), None) => printer.warning(format_args!(
                "{}: not written, for no motion takes the puzzle apart",
                path.display()
            )),
            (None, _) => {}
        }
        if let Some(path) = &self.files.report {
            let title = format!("Puzzle of {} pieces", puzzle.pieces());
            let text = page(puzzle, report, motion.as_ref(), print, &title);
            files::write_whole(path, text.as_bytes(), printer)?;
        }
        Ok(())
    }
}

/// Refuses what does not go with a sheet.
fn check_layout(files: &Files) -> anyhow::Result<()> {
    if files.pull > 0.0 {
        bail!("--layout-on and --pull exclude each other; leave out one of them");
    }
    match kind(files.output.as_deref(), &[Drawing::Svg, Drawing::Dxf, Drawing::Png])? {
        Some((path, Drawing::Png)) => {
            bail!("{}: sheets of --layout-on are written as .svg or .dxf", path.display())
        }
        _ => Ok(()),
    }
}

/// The share of a picture beside the pieces from which on that is said.
const NOTABLE: f64 = 0.01;

/// Says what of a picture is not on the pieces, which it covers.
fn warn_of_proportions(path: &Path, print: &Print, puzzle: &Puzzle, printer: &Printer) {
    let lost = print.beside(puzzle);
    if lost > NOTABLE {
        let ([width, height], [x, y]) = (puzzle.size(), print.size());
        printer.warning(format_args!(
            "{}: {:.0} % of the picture is beside the pieces: it has {x} × {y} pixels, and the puzzle {} × {}",
            path.display(),
            100.0 * lost,
            few(width),
            few(height)
        ));
    }
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
fn kind<'p>(path: Option<&'p Path>, kinds: &[Drawing]) -> anyhow::Result<Option<(&'p Path, Drawing)>> {
    let Some(path) = path else { return Ok(None) };
    let is = |kind: &&Drawing| {
        path.extension().is_some_and(|found| found.eq_ignore_ascii_case(&kind.suffix()[1..]))
    };
    let Some(kind) = kinds.iter().find(is) else {
        let names: Vec<&str> = kinds.iter().map(|kind| kind.suffix()).collect();
        bail!("{}: puzzles are written as {}", path.display(), names.join(" or "))
    };
    Ok(Some((path, *kind)))
}
