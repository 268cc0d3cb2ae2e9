//! The report of a puzzle.

use crate::lock::{is_locked_until, lock_until};
use crate::{Fit, Kerf, Like, Lock, Motion, Neck, Packing, Proof, Puzzle};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, StopReason};
use rayon::prelude::*;
use std::time::Duration;

/// The report of a puzzle. Lengths are in the unit of its outline.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PuzzleReport {
    /// The pieces.
    pub pieces: Vec<PieceReport>,
    /// Clusters of pieces that cannot move relative to each other, each as a list of pieces.
    pub clusters: Vec<Vec<usize>>,
    /// Whether no piece can move relative to another one, tested for every joint motion of the pieces.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub locked: bool,
    /// How that was decided: `merging`, `one_moves` and `multipliers` in integers, `several_move` in double precision, `undecided`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub proof: Proof,
    /// The greatest tested length such that the puzzle stays locked after details of that size are removed from the borders,
    /// relative to the square root of the mean area of a piece; 0 if no tested simplification stays locked, `null` if the puzzle is
    /// not locked.
    pub depth: Option<f64>,
    /// The test with a cut of some width; absent unless requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub kerf: Option<Kerf>,
    /// The places of pieces on a sheet; absent unless requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub packing: Option<Packing>,
    /// The result of the lock test, for [`crate::take_apart`].
    #[cfg_attr(feature = "serde", serde(skip))]
    pub found: Lock,
    /// Sentences about what drawings show of elements that they do not have; omitted if there is nothing.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<String>>"))]
    pub left_out: Vec<String>,
    /// The width that tabs leave to necks at least; `null` if it is not known.
    pub least_neck: Option<f64>,
    /// The pairs of pieces whose common border has no tab.
    pub without_tab: Vec<[usize; 2]>,
    /// The pieces with outlines of their own.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub whimsies: Vec<usize>,
    /// Areas.
    pub area: AreaReport,
    /// The energy after each step of placing pieces of a given shape, see [`Like::energy`]; empty without a shape.
    pub energy: Vec<f64>,
    /// The motion that takes the puzzle apart; absent if there is none, or it was not wanted.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub motion: Option<MotionReport>,
    /// The reason for which the computation ended.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub stop: StopReason,
    /// Time spent on each part.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

/// The report of a piece.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PieceReport {
    /// Its index, from 0.
    pub id: usize,
    /// Its area.
    pub area: f64,
    /// The number of corners of its outline; the drawings contain their positions.
    pub outline_points: usize,
    /// Whether it has a border on the outline of the puzzle.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub is_at_outline: bool,
    /// The pieces that it shares a border with.
    pub neighbours: Vec<usize>,
    /// Its similarity to the requested shape in the best pose found; `null` without a shape.
    pub similarity: Option<Similarity>,
    /// `locked` if it belongs to the largest cluster, otherwise `free`, or `undecided` where that is not known.
    pub lock: &'static str,
    /// Its narrowest place with more than half a per cent of the mean area of a piece on each side; `null` if there is none, as in
    /// convex pieces.
    pub neck: Option<Neck>,
    /// A motion of the piece: velocity at the origin and angular velocity. Empty if none is known.
    pub escape: Vec<f64>,
}

/// The motion that takes a puzzle apart, as far as it was followed.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotionReport {
    /// The pieces that move.
    pub moving: Vec<usize>,
    /// Whether they have left the others.
    pub is_apart: bool,
}

impl From<&Motion> for MotionReport {
    fn from(motion: &Motion) -> Self {
        Self { moving: motion.moving().collect(), is_apart: motion.is_apart }
    }
}

/// The similarity of a piece to the requested shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Similarity {
    /// Intersection over union: the common area of piece and shape over the area of their union.
    pub iou: f64,
    /// The Pompeiu–Hausdorff distance of their curves.
    pub hausdorff: f64,
}

/// Areas, in the unit of the outline squared.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AreaReport {
    /// The sum of the areas of all pieces.
    pub sum: f64,
    /// The area of the outline.
    pub outline: f64,
    /// Whether both are equal, in integers.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub is_exact: bool,
}

/// Time spent on each part; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Making the pieces.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub make: Duration,
    /// The lock test.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub lock: Duration,
    /// The lock test on simplified borders.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub depth: Duration,
    /// Everything.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub total: Duration,
}

/// Tested depths, relative to the square root of the mean area of a piece.
const DEPTHS: [f64; 7] = [0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12];

/// Tests a puzzle with pieces of a given shape and reports the results.
pub fn report_like(like: &Like) -> PuzzleReport {
    let mut report = report(&like.puzzle);
    report.add_similarities(&like.fits, &like.energy);
    report.stop = like.stop.unwrap_or(StopReason::Tolerance);
    report
}

impl PuzzleReport {
    /// Adds how similar pieces are to the shape that was asked for.
    pub(crate) fn add_similarities(&mut self, fits: &[Option<Fit>], energy: &[f64]) {
        for (piece, fit) in self.pieces.iter_mut().zip(fits) {
            piece.similarity = fit.map(|fit| Similarity { iou: fit.iou, hausdorff: fit.hausdorff });
        }
        self.energy = energy.to_vec();
    }

    /// The narrowest neck and its piece; `None` if no piece has one.
    pub fn narrowest(&self) -> Option<(usize, Neck)> {
        let necks = self.pieces.iter().filter_map(|piece| Some((piece.id, piece.neck?)));
        necks.min_by(|a, b| a.1.width.total_cmp(&b.1.width))
    }

    /// The square root of the mean area of a piece: the unit of length for tabs and depths.
    pub fn unit(&self) -> f64 {
        (self.area.outline / self.pieces.len() as f64).sqrt()
    }
}

/// Tests a puzzle and reports the results.
pub fn report(puzzle: &Puzzle) -> PuzzleReport {
    report_until(puzzle, &Control::default())
}

/// As [`report`]. What is not decided when the control stops is reported as undecided; the depth is the greatest proven by then.
pub(crate) fn report_until(puzzle: &Puzzle, control: &Control) -> PuzzleReport {
    let started = Instant::now();
    let found = lock_until(puzzle, control);
    let mut timing = Timing { lock: started.elapsed(), ..Timing::default() };
    let started = Instant::now();
    let depth = found.is_locked().then(|| {
        let holds = |depth: &&f64| is_locked_until(&puzzle.simplified(**depth * puzzle.unit()), control);
        DEPTHS.iter().take_while(holds).last().copied().unwrap_or(0.0)
    });
    timing.depth = started.elapsed();
    timing.total = timing.lock + timing.depth;
    let mut clusters = vec![Vec::new(); found.count];
    for (piece, cluster) in found.clusters.iter().enumerate() {
        clusters[*cluster].push(piece);
    }
    let largest = (0..found.count).max_by_key(|c| (clusters[*c].len(), std::cmp::Reverse(*c))).unwrap_or(0);
    let escape = |piece: usize| {
        let all = found.escape.as_ref().map(|escape| escape.twists[piece]).filter(|twist| *twist != [0.0; 3]);
        found.alone[piece].or(all).map(|twist| twist.to_vec()).unwrap_or_default()
    };
    let mut is_at_outline = vec![false; puzzle.pieces()];
    for border in puzzle.borders.iter().filter(|border| border.right.is_none()) {
        is_at_outline[border.left] = true;
    }
    let state = |piece: usize| match found.proof {
        _ if found.is_locked() || (found.clusters[piece] == largest && clusters[largest].len() > 1) => {
            "locked"
        }
        Proof::Undecided => "undecided",
        _ => "free",
    };
    let necks: Vec<Option<Neck>> =
        (0..puzzle.pieces()).into_par_iter().map(|piece| puzzle.neck(piece)).collect();
    let pieces = (0..puzzle.pieces()).map(|piece| PieceReport {
        id: piece,
        area: puzzle.area(piece),
        outline_points: puzzle.corners(piece).len(),
        is_at_outline: is_at_outline[piece],
        neighbours: puzzle.neighbours(piece),
        similarity: None,
        lock: state(piece),
        neck: necks[piece],
        escape: escape(piece),
    });
    let pieces: Vec<PieceReport> = pieces.collect();
    let doubled: i128 = (0..puzzle.pieces()).map(|piece| puzzle.doubled_area(piece)).sum();
    let area = AreaReport {
        sum: pieces.iter().map(|piece| piece.area).sum(),
        outline: puzzle.outline_area(),
        is_exact: doubled == puzzle.doubled_outline,
    };
    let straight = puzzle.borders.iter().filter(|border| border.corners.len() == 2);
    let without_tab = straight.filter_map(|border| Some([border.left, border.right?])).collect();
    PuzzleReport {
        pieces,
        clusters,
        locked: found.is_locked(),
        proof: found.proof,
        depth,
        kerf: None,
        packing: None,
        found,
        left_out: Vec::new(),
        least_neck: None,
        without_tab,
        whimsies: puzzle.whimsies.clone(),
        area,
        energy: Vec::new(),
        motion: None,
        stop: control.reason().unwrap_or(StopReason::Tolerance),
        timing,
    }
}
