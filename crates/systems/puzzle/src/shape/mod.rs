//! Pieces as similar to a given shape as possible.

mod classics;
mod cover;
mod descend;
mod fit;
mod gauge;
mod lloyd;
mod map;
mod place;
mod pose;
mod regions;
mod register;
mod smooth;
mod target;
mod torus;

pub use classics::PieceName;
pub use fit::Fit;
pub use gauge::{Answer, Variant, gauge, meetings};
pub use map::Map;
pub use pose::Pose;
pub use register::{Registered, register};
pub use target::PieceShape;

use crate::make::{faces_within, lock_by_tabs, mended, step};
use crate::space::Corner;
use crate::{Puzzle, PuzzleError, PuzzleOptions};
use place::Placed;
use pompeiu_core::run::{Control, Limits, Progress, ProgressObserver, StopReason};
use pompeiu_planar::{Outline, Point, first_crossing};
use target::Target;

/// How copies of the shape are placed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Method {
    /// From the best lattices of the plane, by a descent whose energy never increases, and by hops.
    #[default]
    Descent,
    /// Lloyd's method with the shape-matching metric, from random sites.
    Lloyd {
        /// The value of the metric if a ray meets the shape several times.
        answer: Answer,
        /// The part of the shape that must meet a point.
        variant: Variant,
        /// Whether copies are rotated by registering the shape on their regions.
        feedback: bool,
    },
}

/// Options for pieces of a given shape.
#[derive(Clone)]
pub struct LikeOptions<'o> {
    /// The shape.
    pub shape: PieceShape,
    /// How copies of it are placed.
    pub method: Method,
    /// Whether copies may be mirrored.
    pub mirrors: bool,
    /// Whether the outline is the union of whole copies on the best lattice of the plane, close to the given outline: it cuts no
    /// piece.
    pub free_outline: bool,
    /// Limits. When time runs out, the puzzle is made from the best placement so far.
    pub limits: Limits,
    /// Receives progress, and may cancel.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl Default for LikeOptions<'_> {
    fn default() -> Self {
        Self {
            shape: PieceShape::Built(PieceName::Classic),
            method: Method::default(),
            mirrors: true,
            free_outline: false,
            limits: Limits::default(),
            progress: None,
        }
    }
}

/// A puzzle whose pieces are similar to a shape.
#[derive(Clone, Debug)]
pub struct Like {
    /// The puzzle.
    pub puzzle: Puzzle,
    /// For each piece the shape in its best pose.
    pub fits: Vec<Option<Fit>>,
    /// The energy after each step. For descent: the mean over the outline of a hinge of the distance from the nearest copy; the
    /// width of the hinge falls from 0.3 to 0.03 of a piece's side, and the energy never increases. For Lloyd's method: the mean of
    /// the metric, which can increase.
    pub energy: Vec<f64>,
    /// Why the placement ended early.
    pub stop: Option<StopReason>,
}

/// Values per row of a map.
const MAP: usize = 200;

/// Displacements of all borders to try if a border passes through a corner of the outline.
const TRIES: i64 = 8;

/// Makes a puzzle with pieces as similar to a shape as possible; the layout of the options is ignored.
///
/// # Definition
/// Copies of the shape, each with the mean area of a piece, are placed so that little of the outline is uncovered. A piece consists
/// of the points nearest to its copy, by signed distance. Borders are extracted once and smoothed, and the fewest tabs that hold
/// the puzzle together are added.
///
/// # Errors
/// [`PuzzleError`] if sizes or numbers are out of range, or an outline or shape crosses itself.
///
/// # Cost
/// A few seconds for 24 pieces: each step of the descent evaluates 300 points per piece.
pub fn make_like(options: &PuzzleOptions, like: &LikeOptions) -> Result<Like, PuzzleError> {
    let control = Control::start(&like.limits);
    let tell = |progress: &Progress<'_>| {
        if like.progress.is_some_and(|observer| observer.progress(progress).is_break()) {
            control.stop(StopReason::Cancelled);
        }
    };
    make_like_until(options, like, &control, &tell)
}

/// As [`make_like`], with a control in the place of the limits, and without an observer.
pub(crate) fn make_like_until(
    options: &PuzzleOptions,
    like: &LikeOptions,
    control: &Control,
    tell: &(dyn Fn(&Progress<'_>) + Sync),
) -> Result<Like, PuzzleError> {
    options.check()?;
    let target = Target::new(&like.shape.outline()?);
    let tell = |share: f64| tell(&Progress { doing: "placing pieces", share: Some(share) });
    let frame = Frame::new(options)?;
    let most_pixels = regions::most_pixels(options.pieces, like.limits.memory)?;
    let (answer, variant) = match like.method {
        Method::Descent => (Answer::SignedDistance, Variant::Edges),
        Method::Lloyd { answer, variant, .. } => (answer, variant),
    };
    let map = Map::new(&target.outline, answer, variant, MAP);
    tell(0.0);
    let (poses, energy, mut puzzle) = if like.free_outline {
        let poses =
            place::on_lattice(&map, &frame.outline, options.pieces, like.mirrors, options.seed, control)?;
        let (puzzle, poses) = frame.whole(&map, &poses, options.pieces, most_pixels)?;
        (poses, Vec::new(), puzzle)
    } else {
        let Placed { poses, energy } = match like.method {
            Method::Descent => place::place(
                &map,
                &frame.outline,
                options.pieces,
                like.mirrors,
                options.seed,
                control,
                &tell,
            )?,
            Method::Lloyd { feedback, .. } => lloyd::lloyd(
                &map,
                &target.outline,
                &frame.outline,
                options.pieces,
                feedback.then_some(like.mirrors),
                options.seed,
                control,
            ),
        };
        tell(0.9);
        let puzzle = frame.puzzle(&map, &poses, options.pieces, most_pixels)?;
        (poses, energy, puzzle)
    };
    smooth::smooth(&mut puzzle);
    // Wider necks than that may be those of the shape.
    let least = NARROWER[NARROWER.len() - 1] * options.least_neck(puzzle.unit());
    puzzle = mended(puzzle, least);
    let in_unit: Vec<Pose> = poses
        .iter()
        .map(|pose| Pose { place: pose.place.map(|x| x * frame.unit * frame.step), ..*pose })
        .collect();
    let before = fit::fits(&puzzle, &target, &in_unit);
    let shapes: Vec<Option<Outline>> = before
        .iter()
        .map(|fit| fit.and_then(|fit| fit.pose.apply(&target.outline, fit.scale).ok()))
        .collect();
    let neck = options.least_neck(puzzle.unit()) / puzzle.step;
    // Where nothing else holds a piece, a narrower neck does, unless a width was asked for.
    let narrower = if options.neck.is_some() { &NARROWER[..1] } else { &NARROWER[..] };
    let necks: Vec<f64> = narrower.iter().map(|share| share * neck).collect();
    lock_by_tabs(&mut puzzle, (options.tab, &necks), control, &|piece, p| {
        shapes[piece].as_ref().is_some_and(|shape| shape.contains(p))
    });
    let placed: Vec<Pose> = before.iter().flatten().map(|fit| fit.pose).collect();
    let fits = fit::fits(&puzzle, &target, &placed);
    tell(1.0);
    Ok(Like { puzzle, fits, energy, stop: control.reason() })
}

/// The least widths of necks that are tried in turn, relative to the default one.
const NARROWER: [f64; 4] = [1.0, 0.8, 0.6, 0.4];

/// The outline on the lattice, and in units of a piece's side.
struct Frame {
    step: f64,
    size: [i64; 2],
    corners: Vec<Corner>,
    /// The mean side of a piece, in steps.
    unit: f64,
    outline: Outline,
}

impl Frame {
    fn new(options: &PuzzleOptions) -> Result<Self, PuzzleError> {
        let too_narrow = |_| PuzzleError::Narrow { piece: 0 };
        let rectangle = |[w, h]: [f64; 2]| vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]];
        let given = match &options.outline {
            Some(outline) => outline.clone(),
            None => Outline::new(rectangle(options.size)).map_err(too_narrow)?,
        };
        let [low, high] = given.bounds();
        let scale = [0, 1].map(|k| options.size[k] / (high[k] - low[k]));
        let scale = scale[0].min(scale[1]);
        let extent = [0, 1].map(|k| scale * (high[k] - low[k]));
        let step = step(extent);
        let on_lattice = |p: Point| [0, 1].map(|k| (scale * (p[k] - low[k]) / step).round());
        // Merges corners that coincide on the lattice.
        let rounded = given.map(on_lattice).map_err(too_narrow)?;
        if let Some(crossing) = first_crossing(&rounded) {
            return Err(PuzzleError::Crossing { sides: crossing.sides, place: crossing.place });
        }
        let corners = rounded.points().iter().map(|p| p.map(|x| x as i64)).collect();
        let size = extent.map(|side| (side / step).round() as i64);
        let unit = (rounded.area() / options.pieces as f64).sqrt();
        let outline = rounded.map(|p| p.map(|x| x / unit)).map_err(too_narrow)?;
        Ok(Self { step, size, corners, unit, outline })
    }

    /// The regions of copies as pieces.
    fn puzzle(
        &self,
        map: &Map,
        poses: &[Pose],
        most: usize,
        most_pixels: f64,
    ) -> Result<Puzzle, PuzzleError> {
        let borders = regions::borders(map, poses, &self.outline, most_pixels);
        let mut found = Err(PuzzleError::Narrow { piece: 0 });
        for i in 0..TRIES {
            // If a border passes through a corner of the outline, all borders move by a step.
            let shift = [i % 3, i / 3];
            let on_lattice = |p: Point| [0, 1].map(|k| (p[k] * self.unit).round() as i64 + shift[k]);
            let segments: Vec<[Corner; 2]> =
                borders.iter().map(|ends| ends.map(on_lattice)).filter(|[a, b]| a != b).collect();
            found = faces_within(&segments, &self.corners, most, self.step, self.size);
            if found.is_ok() {
                break;
            }
        }
        found
    }

    /// The whole regions of the first copies, without those of the other copies around them.
    fn whole(
        &self,
        map: &Map,
        poses: &[Pose],
        count: usize,
        most_pixels: f64,
    ) -> Result<(Puzzle, Vec<Pose>), PuzzleError> {
        let too_narrow = |_| PuzzleError::Narrow { piece: 0 };
        let room = 1.2 * map.radius();
        let places = || poses[..count].iter().map(|pose| pose.place);
        let low = [0, 1].map(|k| places().map(|p| p[k]).fold(f64::INFINITY, f64::min) - room);
        let high = [0, 1].map(|k| places().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max) + room);
        let moved = |p: Point| [p[0] - low[0], p[1] - low[1]];
        let [w, h] = moved(high);
        let outline = Outline::new(vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]).map_err(too_narrow)?;
        let corner = |p: &Point| p.map(|x| (x * self.unit).round() as i64);
        let wide = Self {
            corners: outline.points().iter().map(corner).collect(),
            size: corner(&[w, h]),
            outline,
            step: self.step,
            unit: self.unit,
        };
        let moved: Vec<Pose> = poses.iter().map(|pose| Pose { place: moved(pose.place), ..*pose }).collect();
        let all = wide.puzzle(map, &moved, usize::MAX, most_pixels)?;
        // The piece of a copy contains the deepest point of the copy.
        let deepest = map.deepest();
        let outlines: Vec<Option<Outline>> =
            (0..all.pieces()).map(|piece| Outline::new(all.outline(piece)).ok()).collect();
        let piece_of = |pose: &Pose| {
            let p = pose.turn().to_place(deepest).map(|x| x * self.unit * self.step);
            outlines.iter().position(|outline| outline.as_ref().is_some_and(|outline| outline.contains(p)))
        };
        let mut pieces: Vec<usize> = moved[..count].iter().filter_map(piece_of).collect();
        pieces.sort_unstable();
        pieces.dedup();
        let puzzle = (pieces.len() == count).then(|| all.of_pieces(&pieces)).flatten();
        puzzle.map(|puzzle| (puzzle, moved)).ok_or(PuzzleError::Outline)
    }
}
