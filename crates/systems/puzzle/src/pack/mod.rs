//! Packing pieces on a sheet.

mod apart;
mod body;
mod field;
mod greedy;
mod mask;
mod near;
mod separate;
mod shrink;
mod strip;

use crate::{Puzzle, PuzzleError};
use body::{Body, Pose};
use greedy::{Packer, Placed, Try};
use pompeiu_core::run::{Control, Progress};
use pompeiu_planar::{Outline, Point, offset};
use rayon::prelude::*;
use shrink::{ROUNDING, shrink};
use std::f64::consts::FRAC_PI_2;
use strip::Strip;

/// The places of the pieces of a puzzle on a sheet.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Packing {
    /// Width and height of the sheet.
    pub sheet: [f64; 2],
    /// The share of the sheet that pieces cover.
    pub used: f64,
    /// The share that they cover of the part of the sheet up to the last one.
    pub filled: f64,
    /// The place of each piece.
    pub places: Vec<Place>,
}

/// The place of a piece: turned about the origin, then moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Place {
    /// The angle of the turn in degrees, from the first axis to the second.
    pub turn: f64,
    /// The displacement after that.
    pub shift: Point,
}

impl Place {
    /// Where a point of the piece comes to lie.
    pub fn apply(&self, p: Point) -> Point {
        let [x, y] = turned(p, self.turn);
        [x + self.shift[0], y + self.shift[1]]
    }
}

/// A point turned by an angle in degrees; without rounding by quarters of a turn.
fn turned([x, y]: Point, degrees: f64) -> Point {
    let quarters = (degrees / 90.0).round();
    let (sine, cosine) = libm::sincos((degrees - 90.0 * quarters).to_radians());
    greedy::turned([cosine * x - sine * y, sine * x + cosine * y], quarters.rem_euclid(4.0) as u8)
}

/// Tries of the greedy choice for one piece, and at least and at most for all.
const TRIES: usize = 1200;
const FEWEST_TRIES: usize = 4;
const MOST_TRIES: usize = 24;

/// Distance from a piece up to which the depth of others tells where to move them, relative to the side of a piece.
const AWAY: f64 = 0.1;

/// Packs the pieces of a puzzle on a sheet.
///
/// # Definition
/// The path of a piece is its outline, moved outwards by half the cut. Pieces are turned by any angle and moved, not mirrored, so that
/// the paths of any two are at least a cut apart, and half a cut from the edges of the sheet: what is cut away around one piece touches
/// no other. They lie as near to one of the shorter edges as was found; to another one only if the sheet is too small for that.
///
/// A greedy choice with quarters of a turn on a grid of cells is the start. The strip of the sheet that it needs is then made shorter, step by
/// step, and pieces that overlap in it are separated by a descent of all and by moves and exchanges of single ones.
///
/// # Accuracy
/// Distances hold to rounding. The greedy choice takes cells that are within the distance of a piece once; a shorter strip is taken only
/// if the distances of all sides of paths are large enough.
///
/// # Limits
/// Nothing says how near to the best packing this is. A time limit ends it with the shortest strip so far.
///
/// # Errors
/// [`PuzzleError::Sheet`] with the largest number of pieces that a greedy choice placed, if all have no room;
/// [`PuzzleError::PackingStopped`] with that number if a limit ended the greedy choice.
///
/// # Cost
/// For each piece and each of up to 48 candidates, the rows of cells near its place, each with some tens of looks; then two and a half million pairs of
/// pieces and four thousand for each piece, each with some tens of looks at a field. Up to 24 greedy choices and up to three times the pairs
/// where the sheet is too small for the first strip. The same for any number of threads.
///
/// # Source
/// `imamichi_iterated_2009`, `umetani_solving_2009` and `gardeyn_open_2025`: see `shrink.rs`.
pub fn pack(puzzle: &Puzzle, sheet: [f64; 2], kerf: f64, control: &Control) -> Result<Packing, PuzzleError> {
    pack_and_tell(puzzle, sheet, kerf, control, &|_| ())
}

/// As [`pack`], for somebody who is told how far it has come.
pub(crate) fn pack_and_tell(
    puzzle: &Puzzle,
    sheet: [f64; 2],
    kerf: f64,
    control: &Control,
    tell: &dyn Fn(&Progress<'_>),
) -> Result<Packing, PuzzleError> {
    let pieces = puzzle.pieces();
    let unit = puzzle.unit();
    let paths: Vec<Vec<Point>> = (0..pieces).map(|piece| path(puzzle, piece, kerf)).collect();
    let bodies: Vec<Body> = paths.par_iter().map(|path| Body::new(path, kerf + AWAY * unit, unit)).collect();
    let area: f64 = (0..pieces).map(|piece| puzzle.area(piece)).sum();
    let work = Work { paths, bodies, area, unit, sheet, kerf, control, tell };
    // Along the longer side of the sheet, and then along the other one.
    let along = usize::from(sheet[0] < sheet[1]);
    if let Some(found) = work.on_strip(along) {
        return Ok(found);
    }
    let axes = [along, 1 - along];
    let packers = axes.map(|axis| Packer::new(&work.paths, unit, work.strip(axis), kerf));
    let mut fits = 0;
    for number in 0..(TRIES / pieces).clamp(FEWEST_TRIES, MOST_TRIES) {
        if number > 0 && control.is_stopped() {
            break;
        }
        let packer = &packers[number % 2];
        let found = packer.pack(&Try::number(number / 2), control);
        fits = fits.max(found.iter().flatten().count());
        if let Some(packing) = work.packing(axes[number % 2], packer.width, &found) {
            return Ok(packing);
        }
    }
    let [width, height] = sheet;
    let found = work.on_strip(1 - along);
    found.ok_or(if control.is_stopped() && work.area <= width * height {
        PuzzleError::PackingStopped { placed: fits, pieces }
    } else {
        let needed = work
            .paths
            .iter()
            .filter_map(|path| Outline::new(path.clone()).ok())
            .map(|path| path.area())
            .sum();
        PuzzleError::Sheet { width, height, needed, gap: kerf, fits, pieces }
    })
}

/// What is packed.
struct Work<'c> {
    paths: Vec<Vec<Point>>,
    bodies: Vec<Body>,
    /// Area of all pieces, and the side of one.
    area: f64,
    unit: f64,
    sheet: [f64; 2],
    kerf: f64,
    control: &'c Control,
    tell: &'c dyn Fn(&Progress<'_>),
}

impl Work<'_> {
    /// Width and length of the sheet as a strip along an axis.
    fn strip(&self, axis: usize) -> [f64; 2] {
        [self.sheet[1 - axis], self.sheet[axis]]
    }

    /// A packing along an axis, from a greedy choice on a strip that is as long as needed.
    fn on_strip(&self, axis: usize) -> Option<Packing> {
        let [width, length] = self.strip(axis);
        if self.area > width * length {
            return None;
        }
        let packer = Packer::new(&self.paths, self.unit, [width, f64::INFINITY], self.kerf);
        self.packing(axis, packer.width, &packer.pack(&Try::number(0), self.control))
    }

    /// The packing along an axis that places on a strip of some width come to; none if it is too long, or pieces have no place.
    fn packing(&self, axis: usize, width: f64, placed: &[Option<Placed>]) -> Option<Packing> {
        let start: Option<Vec<Pose>> =
            self.bodies.iter().zip(placed).map(|(b, p)| Some(pose(b, (*p)?))).collect();
        let tell = |share| (self.tell)(&Progress { doing: "packing pieces", share: Some(share) });
        let strip = Strip::new(&self.bodies, start?, width, self.unit, self.kerf);
        let poses = shrink(strip, self.control, &tell);
        let places: Vec<Place> =
            self.bodies.iter().zip(&poses).map(|(body, pose)| place(body, pose, axis, width)).collect();
        let laid =
            self.paths.iter().zip(&places).flat_map(|(path, place)| path.iter().map(|p| place.apply(*p)));
        let end = laid.map(|p| p[axis]).fold(0.0, f64::max);
        let [across, length] = self.strip(axis);
        if end > length - 0.5 * self.kerf + ROUNDING * self.unit {
            return None;
        }
        let [used, filled] = [across * length, end * across].map(|whole| self.area / whole);
        Some(Packing { sheet: self.sheet, used, filled, places })
    }
}

/// A place on cells as a pose.
fn pose(body: &Body, Placed { quarters, shift }: Placed) -> Pose {
    let [x, y] = greedy::turned(body.middle, quarters);
    Pose::new([x + shift[0], y + shift[1]], f64::from(quarters) * FRAC_PI_2)
}

/// A pose on a strip as a place on the sheet. Strips go along its second axis; for the first one they are turned back by a quarter.
fn place(body: &Body, pose: &Pose, axis: usize, width: f64) -> Place {
    let (turn, at) = match axis {
        0 => (pose.angle.to_degrees() - 90.0, [pose.at[1], width - pose.at[0]]),
        _ => (pose.angle.to_degrees(), pose.at),
    };
    let turn = turn.rem_euclid(360.0);
    let [x, y] = turned(body.middle, turn);
    Place { turn, shift: [at[0] - x, at[1] - y] }
}

/// The outline of a piece, moved outwards by half the cut.
pub(crate) fn path(puzzle: &Puzzle, piece: usize, kerf: f64) -> Vec<Point> {
    let points = puzzle.outline(piece);
    let outline = (kerf > 0.0).then(|| Outline::new(points.clone()).ok()).flatten();
    let grown = outline.map(|outline| offset(&outline, 0.5 * kerf)).unwrap_or_default();
    let largest = grown.into_iter().max_by(|a, b| a.area().total_cmp(&b.area()));
    largest.map_or(points, Outline::into_points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Layout, PuzzleOptions, Tab, make};
    use pompeiu_planar::{distance_to_outline, segments_meet};

    /// That paths lie on the sheet and are nowhere nearer than the gap, by all their sides.
    fn check(puzzle: &Puzzle, packing: &Packing, kerf: f64) {
        let laid: Vec<Outline> = (0..puzzle.pieces())
            .map(|piece| {
                let points: Vec<Point> =
                    path(puzzle, piece, kerf).into_iter().map(|p| packing.places[piece].apply(p)).collect();
                Outline::new(points).unwrap()
            })
            .collect();
        let gap = kerf * (1.0 - 1e-9);
        for (i, a) in laid.iter().enumerate() {
            for k in 0..2 {
                let [low, high] = a.bounds();
                assert!(low[k] >= 0.5 * gap - 1e-9 && high[k] <= packing.sheet[k] - 0.5 * gap + 1e-9, "{i}");
            }
            let [low, high] = a.bounds();
            for (j, b) in laid.iter().enumerate().skip(i + 1) {
                let [lower, higher] = b.bounds();
                if (0..2).any(|k| lower[k] > high[k] + gap || higher[k] < low[k] - gap) {
                    continue;
                }
                assert!(!a.contains(b.points()[0]) && !b.contains(a.points()[0]), "{i} {j}");
                assert!(a.sides().all(|s| b.sides().all(|t| !segments_meet(s, t))), "{i} {j}");
                for (of, other) in [(a, b), (b, a)] {
                    let near = of.points().iter().map(|p| distance_to_outline(*p, other));
                    assert!(near.fold(f64::INFINITY, f64::min) >= gap, "{i} {j}");
                }
            }
        }
    }

    #[test]
    fn the_end_of_the_time_is_not_taken_for_a_small_sheet() {
        let puzzle = make(&PuzzleOptions { pieces: 12, ..PuzzleOptions::default() }).unwrap();
        let stopped = Control::default();
        stopped.stop(pompeiu_core::run::StopReason::Time);
        let pack = |sheet| pack(&puzzle, sheet, 0.0, &stopped);
        assert!(matches!(pack([1e4, 1e4]), Err(PuzzleError::PackingStopped { pieces: 12, .. })));
        assert!(matches!(pack([1.0, 1.0]), Err(PuzzleError::Sheet { .. })));
    }

    #[test]
    fn pieces_lie_on_the_sheet_a_cut_apart() {
        // A greedy choice alone fills 0.66, 0.896, 0.54 and 0.58; the sheet of the third is too small for it.
        for (layout, tab, pieces, kerf, sheet, [used, filled]) in [
            (Layout::Grid, Tab::Knob, 12, 0.3, [370.0, 245.0], [0.66, 0.69]),
            (Layout::Grid, Tab::None, 12, 0.3, [209.0, 330.0], [0.86, 0.897]),
            (Layout::Voronoi, Tab::Dovetail, 12, 1.0, [250.0, 425.0], [0.56, 0.63]),
            (Layout::Hexagons, Tab::Knob, 10, 0.0, [5000.0, 250.0], [0.0, 0.65]),
        ] {
            let options = PuzzleOptions { pieces, layout, tab, ..PuzzleOptions::default() };
            let puzzle = make(&options).unwrap();
            let packing = pack(&puzzle, sheet, kerf, &Control::default()).unwrap();
            check(&puzzle, &packing, kerf);
            assert!(packing.used >= used, "{layout:?}: {}", packing.used);
            assert!(packing.filled >= filled, "{layout:?}: {}", packing.filled);
        }
    }

    #[test]
    fn packings_are_the_same_for_any_number_of_threads() {
        let puzzle = make(&PuzzleOptions { pieces: 6, ..PuzzleOptions::default() }).unwrap();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| pack(&puzzle, [500.0, 260.0], 0.2, &Control::default()).unwrap())
        };
        let first = on(1);
        check(&puzzle, &first, 0.2);
        // Some pieces are turned by other angles than quarters.
        assert!(first.places.iter().any(|place| place.turn % 90.0 != 0.0), "{:?}", first.places);
        for threads in [2, 8] {
            assert_eq!(on(threads), first, "{threads} threads");
        }
    }

    #[test]
    fn points_are_turned_by_degrees() {
        let [x, y] = turned([2.0, 1.0], 30.0);
        let [c, s] = [0.75_f64.sqrt(), 0.5];
        assert!((x - (2.0 * c - s)).abs() < 1e-15 && (y - (2.0 * s + c)).abs() < 1e-15);
        for (turn, p) in [(0.0, [2.0, 1.0]), (90.0, [-1.0, 2.0]), (180.0, [-2.0, -1.0]), (-90.0, [1.0, -2.0])]
        {
            assert_eq!(turned([2.0, 1.0], turn), p);
            assert_eq!(turned([2.0, 1.0], turn + 360.0), p);
        }
    }

    #[test]
    fn a_sheet_that_is_too_small_is_refused_with_the_number_that_fits() {
        let puzzle = make(&PuzzleOptions { pieces: 6, tab: Tab::None, ..PuzzleOptions::default() }).unwrap();
        let on = |sheet, kerf| match pack(&puzzle, sheet, kerf, &Control::default()) {
            Ok(packing) => {
                check(&puzzle, &packing, kerf);
                6
            }
            Err(PuzzleError::Sheet { fits, pieces: 6, needed, .. }) => {
                // Squares with half a cut around them, whose corners may be round.
                let side = 100.0 + kerf;
                assert!(needed <= 6.0 * side * side && needed > 6.0 * side * side - 2.0 * kerf, "{needed}");
                fits
            }
            Err(error) => panic!("{error}"),
        };
        // Six squares of 100 with paths 0.5 outside, and 1 between those.
        assert_eq!(on([206.5, 110.0], 1.0), 2);
        assert_eq!(on([110.0, 412.0], 1.0), 4);
        assert_eq!(on([50.0, 1e9], 1.0), 0);
        assert_eq!(on([1e9, 110.0], 1.0), 6);
        assert_eq!(on([1e9, 1e9], 0.0), 6);
    }
}
