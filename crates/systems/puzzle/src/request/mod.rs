//! What can be asked: the options of [`PuzzleRequest`], as every door offers them.

mod piece;

pub use piece::PieceSource;

use crate::shape::make_like_until;
use crate::{
    Answer, Like, LikeOptions, Method, Motion, MotionReport, Puzzle, PuzzleError, PuzzleOptions,
    PuzzleReport, Variant, kerf, take_apart,
};
use crate::{Layout, Tab, make::make_until, pack::pack_and_tell, report::report_until};
use pompeiu_core::request::{Length, LengthError, Limit, Report, Request};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Progress, RunContext, StopReason};
use pompeiu_planar::silhouette::SilhouetteOptions;
use pompeiu_planar::{Outline, ShapeError, ShapeSource};
use std::path::{Path, PathBuf};

#[cfg(feature = "clap")]
use pompeiu_core::request::values;

/// The unit of a puzzle.
const UNIT: &str = "mm";

/// Make a jigsaw puzzle, and decide whether it holds together.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[allow(clippy::struct_excessive_bools, reason = "each one is an option")]
pub struct PuzzleRequest {
    /// Number of pieces; hexagons, and pieces within an outline, come near to it.
    #[cfg_attr(feature = "clap", arg(long, short = 'n', value_name = "N"))]
    pub pieces: usize,
    /// The outline of the puzzle: a picture (its largest part), a drawing, a list of points, or in Python corners; a rectangle by default.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub outline: Option<ShapeSource>,
    /// Width and height, in millimetres for drawings; an outline is scaled to fit into that.
    #[cfg_attr(feature = "clap", arg(long, value_parser = size, value_name = "WIDTHxHEIGHT"))]
    pub size: [f64; 2],
    /// The pieces before they get tabs.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub layout: Layout,
    /// The shape of tabs on borders between pieces.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub tab: Tab,
    /// The least width of necks that tabs leave, in millimetres or with another unit; by default 15 % of the mean side of a piece, and 3 mm
    /// where these are at most a fifth of it.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "WIDTH"))]
    pub neck: Option<Length>,
    /// Seed of places and sides.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SEED"))]
    pub seed: u64,
    /// Make pieces as similar to a shape as possible, with as few tabs as hold the puzzle together: square, hexagon, classic, corner,
    /// fish, bird, star, a file, or in Python corners; the layout is not used then.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SHAPE"))]
    pub piece: Option<PieceSource>,
    /// The arrangement of copies of the shape of pieces.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub method: Placing,
    /// Lloyd's method: what counts where a ray from the site meets the shape several times.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub metric: Answer,
    /// Lloyd's method: measure by the shape's corners instead of its sides.
    #[cfg_attr(feature = "clap", arg(long))]
    pub corners: bool,
    /// Lloyd's method: turn copies as the registration of the shape on their regions says.
    #[cfg_attr(
        feature = "clap",
        arg(long = "no-feedback", action = clap::ArgAction::SetFalse, help = "Lloyd's method: never turn copies as the registration of the shape on their regions says")
    )]
    pub feedback: bool,
    /// Mirror copies of the shape where they fit better.
    #[cfg_attr(feature = "clap", arg(long = "no-mirrors", action = clap::ArgAction::SetFalse, help = "Mirror no copy of the shape"))]
    pub mirrors: bool,
    /// Let the outline be what whole copies of the shape leave, so that it cuts no piece; it comes near to the one asked for.
    #[cfg_attr(feature = "clap", arg(long))]
    pub free_outline: bool,
    /// Make a piece of an outline, twice as large as the others: a picture (its largest part), a drawing or a list of points; may be repeated.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub whimsy: Vec<ShapeSource>,
    /// Width of the cut, such as 0.2 for millimetres, 0.2mm or 8mil: paths are moved by half of it, and whether the puzzle holds with the gap
    /// is tested.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "WIDTH"))]
    pub kerf: Option<Length>,
    /// Lay the pieces out on a sheet of this width and height, with the width of the cut between their paths.
    #[cfg_attr(feature = "clap", arg(long, value_parser = size, value_name = "WIDTHxHEIGHT"))]
    pub layout_on: Option<[f64; 2]>,
}

/// A width and a height.
#[cfg(feature = "clap")]
fn size(text: &str) -> Result<[f64; 2], String> {
    values::tuple::<2>(&text.replace(['x', '×'], ","))
        .map_err(|_| "expected a width and a height, such as 300x200".to_owned())
}

impl Default for PuzzleRequest {
    fn default() -> Self {
        let PuzzleOptions { size, pieces, layout, tab, neck, seed, .. } = PuzzleOptions::default();
        let LikeOptions { mirrors, free_outline, .. } = LikeOptions::default();
        Self {
            pieces,
            outline: None,
            size,
            layout,
            tab,
            neck: neck.and_then(|width| Length::new(width).ok()),
            seed,
            piece: None,
            method: Placing::default(),
            metric: Answer::default(),
            corners: false,
            feedback: true,
            mirrors,
            free_outline,
            whimsy: Vec::new(),
            kerf: None,
            layout_on: None,
        }
    }
}

impl Request for PuzzleRequest {
    const NAME: &'static str = "puzzle";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = PuzzleReport;
}

impl Report for PuzzleReport {
    fn stop(&self) -> StopReason {
        self.stop
    }
}

/// The arrangement of copies of a shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Placing {
    /// From lattices, by a descent whose energy never increases, and hops.
    #[default]
    Descent,
    /// Lloyd's method with the shape-matching metric.
    Lloyd,
}

/// A puzzle, and what was found of it.
#[derive(Clone, Debug)]
pub struct PuzzleAnswer {
    /// The puzzle.
    pub puzzle: Puzzle,
    /// The report.
    pub report: PuzzleReport,
    /// The motion that takes it apart, if it was wanted and there is one.
    pub motion: Option<Motion>,
    /// The files that were read, with the number of corners of each outline.
    pub read: Vec<(PathBuf, usize)>,
}

/// Why there is no puzzle.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PuzzleRequestError {
    /// A shape cannot be used.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A width cannot be converted to millimetres.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// A name of a shape that is neither built in nor a file.
    #[error(
        "piece: expected \"square\", \"hexagon\", \"classic\", \"corner\", \"fish\", \"bird\", \"star\" or a file; {0}"
    )]
    Piece(ShapeError),
    /// A shape with holes.
    #[error(
        "{source_name}: the shape has holes ({holes}); fill them, for neither a puzzle nor a piece can have any"
    )]
    Holes {
        /// Where it comes from.
        source_name: String,
        /// Number of holes.
        holes: usize,
    },
    /// The outline in a file cannot be that of a puzzle.
    #[error("{}: {error}", path.display())]
    Outline {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: PuzzleError,
    },
    /// Options that need a shape of pieces, without one.
    #[error("{option} is for pieces of a given shape; give the shape with piece, or leave out {option}")]
    NoPiece {
        /// The option.
        option: &'static str,
    },
    /// Two options that exclude each other.
    #[error("{first} and {second} exclude each other; leave out one of them")]
    Exclusive {
        /// The first.
        first: &'static str,
        /// The second.
        second: &'static str,
    },
    /// The puzzle cannot be made.
    #[error(transparent)]
    Puzzle(#[from] PuzzleError),
}

impl PuzzleRequest {
    /// The files that are read.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let piece = self.piece.as_ref().and_then(PieceSource::file);
        self.outline.iter().chain(&self.whimsy).filter_map(ShapeSource::file).chain(piece)
    }

    /// Makes a puzzle, decides whether it holds together, with the gap of a cut where there is one, and finds the motion that takes it
    /// apart if it is wanted.
    ///
    /// When a limit ends this early, the puzzle tiles its outline all the same: cells are less regular, tabs are missing, or what is
    /// not decided is reported as undecided.
    ///
    /// # Errors
    /// [`PuzzleRequestError`].
    pub fn run(
        &self,
        wants_motion: bool,
        context: &RunContext<'_>,
    ) -> Result<PuzzleAnswer, PuzzleRequestError> {
        self.check()?;
        let width = self.kerf_width()?;
        let (mut read, mut left_out) = (Vec::new(), Vec::new());
        let mut whole = |source: &ShapeSource| whole(source, &mut read, &mut left_out);
        let options = PuzzleOptions {
            outline: self.outline.as_ref().map(&mut whole).transpose()?,
            size: self.size,
            pieces: self.pieces,
            layout: self.layout,
            tab: self.tab,
            neck: self.neck.as_ref().map(|width| width.in_unit(UNIT)).transpose()?,
            whimsies: self.whimsy.iter().map(&mut whole).collect::<Result<_, _>>()?,
            seed: self.seed,
        };
        let shape = self.piece.as_ref().map(|piece| piece.shape(&mut whole)).transpose()?;
        let control = context.control();
        let work = || -> Result<_, PuzzleError> {
            let started = Instant::now();
            let tell = |progress: &Progress<'_>| {
                if context.progress().is_some_and(|observer| observer.progress(progress).is_break()) {
                    control.stop(StopReason::Cancelled);
                }
            };
            let (puzzle, fits) = match shape {
                None => (make_until(&options, &control)?, None),
                Some(shape) => {
                    let like = LikeOptions {
                        shape,
                        method: self.method(),
                        mirrors: self.mirrors,
                        free_outline: self.free_outline,
                        ..LikeOptions::default()
                    };
                    let Like { puzzle, fits, energy, .. } =
                        make_like_until(&options, &like, &control, &tell)?;
                    (puzzle, Some((fits, energy)))
                }
            };
            let made = started.elapsed();
            let mut report = report_until(&puzzle, &control);
            report.left_out = left_out;
            report.least_neck = (self.tab != Tab::None).then(|| options.least_neck(puzzle.unit()));
            if let Some((fits, energy)) = &fits {
                report.add_similarities(fits, energy);
            }
            if width > 0.0 {
                report.kerf = Some(kerf(&puzzle, width, &control));
            }
            if let Some(sheet) = self.layout_on {
                report.packing = Some(pack_and_tell(&puzzle, sheet, width, &control, &tell)?);
            }
            let motion = wants_motion.then(|| take_apart(&puzzle, &report.found, &control)).flatten();
            report.motion = motion.as_ref().map(MotionReport::from);
            report.stop = control.reason().unwrap_or(StopReason::Tolerance);
            report.timing.make = made;
            report.timing.total = started.elapsed();
            Ok((puzzle, report, motion))
        };
        let made = context.on_threads(work);
        let (puzzle, report, motion) = made.map_err(|error| self.with_file(error))?;
        Ok(PuzzleAnswer { puzzle, report, motion, read })
    }

    /// The width of the cut in millimetres; 0 where none is given.
    ///
    /// # Errors
    /// [`LengthError`] for a percentage.
    pub fn kerf_width(&self) -> Result<f64, LengthError> {
        self.kerf.as_ref().map_or(Ok(0.0), |width| width.in_unit(UNIT))
    }

    fn check(&self) -> Result<(), PuzzleRequestError> {
        let defaults = Self::default();
        let of_piece = [
            ("method", self.method != defaults.method),
            ("metric", self.metric != defaults.metric),
            ("corners", self.corners),
            ("feedback", self.feedback != defaults.feedback),
            ("mirrors", self.mirrors != defaults.mirrors),
            ("free_outline", self.free_outline),
        ];
        if self.piece.is_none() {
            if let Some((option, _)) = of_piece.into_iter().find(|(_, is_given)| *is_given) {
                return Err(PuzzleRequestError::NoPiece { option });
            }
        } else if !self.whimsy.is_empty() {
            return Err(PuzzleRequestError::Exclusive { first: "piece", second: "whimsy" });
        } else if self.layout != defaults.layout {
            return Err(PuzzleRequestError::Exclusive { first: "piece", second: "layout" });
        } else if self.free_outline && self.method != defaults.method {
            return Err(PuzzleRequestError::Exclusive { first: "free_outline", second: "method" });
        }
        let is_side = |x: &f64| x.is_finite() && *x > 0.0;
        if let Some(value) = self.layout_on.iter().flatten().copied().find(|x| !is_side(x)) {
            let expected = "its width and its height must be finite and above 0";
            return Err(PuzzleError::Option { what: "layout_on", value, expected }.into());
        }
        Ok(())
    }

    /// How copies of the shape are placed.
    fn method(&self) -> Method {
        match self.method {
            Placing::Descent => Method::Descent,
            Placing::Lloyd => Method::Lloyd {
                answer: self.metric,
                variant: if self.corners { Variant::Points } else { Variant::Edges },
                feedback: self.feedback,
            },
        }
    }

    /// An error of the outline names its file.
    fn with_file(&self, error: PuzzleError) -> PuzzleRequestError {
        match (&error, self.outline.as_ref().and_then(ShapeSource::file)) {
            (PuzzleError::Crossing { .. }, Some(path)) => {
                PuzzleRequestError::Outline { path: path.to_owned(), error }
            }
            _ => error.into(),
        }
    }
}

/// Holes of less than this share of an outline are filled: specks of a picture with noise.
const SPECK: f64 = 1e-3;

/// An outline without holes but for specks; notes the file that it comes from, and what is left out of it.
fn whole(
    source: &ShapeSource,
    read: &mut Vec<(PathBuf, usize)>,
    left_out: &mut Vec<String>,
) -> Result<Outline, PuzzleRequestError> {
    let (region, missing) = source.region(&SilhouetteOptions::default())?;
    left_out.extend(missing.iter().map(|missing| format!("{source}: {missing}")));
    let area = region.outer.area();
    let (specks, holes): (Vec<f64>, Vec<f64>) =
        region.holes.iter().map(|hole| hole.area() / area).partition(|share| *share < SPECK);
    if !holes.is_empty() {
        return Err(PuzzleRequestError::Holes { source_name: source.to_string(), holes: holes.len() });
    }
    if !specks.is_empty() {
        let (number, percent) = (specks.len(), 100.0 * specks.iter().sum::<f64>());
        left_out.push(format!(
            "{source}: {number} holes smaller than a thousandth of the shape are filled, {percent:.2} % of it in all"
        ));
    }
    read.extend(source.file().map(|path| (path.to_owned(), region.outer.points().len())));
    Ok(region.outer)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::run::Limits;
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicBool, Ordering};

    #[test]
    fn widths_are_in_millimetres_whatever_their_unit() {
        let width = |text: &str| {
            PuzzleRequest { kerf: Some(text.parse().unwrap()), ..PuzzleRequest::default() }.kerf_width()
        };
        assert_eq!((width("0.2"), width("200um"), width("8mil")), (Ok(0.2), Ok(0.2), Ok(0.2032)));
        assert!(matches!(width("1%"), Err(LengthError::Percent(_))));
        let request = PuzzleRequest { neck: Some("1%".parse().unwrap()), ..PuzzleRequest::default() };
        let error = request.run(false, &RunContext::default()).unwrap_err();
        assert!(matches!(error, PuzzleRequestError::Length(_)), "{error}");
    }

    #[test]
    fn specks_are_filled_and_larger_holes_refused() {
        let outline = |hole: f64| {
            let path = std::env::temp_dir().join(format!("pompeiu-specks-{}-{hole}.svg", std::process::id()));
            let holes = format!("M20 20h{hole}v{hole}h-{hole}Z M60 60h1v1h-1Z");
            let drawing =
                format!("<svg><path fill-rule='evenodd' d='M0 0H100V90L50 100L0 90Z {holes}'/></svg>");
            std::fs::write(&path, drawing).unwrap();
            let request = PuzzleRequest {
                pieces: 4,
                outline: Some(ShapeSource::File(path.clone())),
                ..PuzzleRequest::default()
            };
            let found = request.run(false, &RunContext::default());
            std::fs::remove_file(path).unwrap();
            found
        };
        let report = outline(2.0).unwrap().report;
        assert!(report.left_out[0].contains("2 holes smaller than a thousandth of the shape are filled"));
        assert!((report.area.outline - 9500.0 * 4.0).abs() < 1.0, "{}", report.area.outline);
        assert!(matches!(outline(4.0), Err(PuzzleRequestError::Holes { holes: 1, .. })));
    }

    /// The first share is told before the first attempt: who ends the work there gets the greedy choice.
    #[test]
    fn packing_is_watched_and_can_be_ended() {
        let request =
            PuzzleRequest { pieces: 12, layout_on: Some([400.0, 600.0]), ..PuzzleRequest::default() };
        let ended = AtomicBool::new(false);
        let watch = |progress: &Progress<'_>| {
            let is_packing = progress.doing == "packing pieces";
            ended.fetch_or(is_packing, Ordering::Relaxed);
            if is_packing { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let context = RunContext::start(Limits::default()).watched_by(&watch);
        let report = request.run(false, &context).unwrap().report;
        assert!(ended.into_inner());
        assert_eq!(report.stop, StopReason::Cancelled);
        assert_eq!(report.packing.unwrap().places.len(), report.pieces.len());
    }
}
