//! Packing pieces on a sheet.

mod mask;

use crate::{Puzzle, PuzzleError};
use mask::{Cells, Mask};
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, offset};
use rayon::prelude::*;

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
    /// Quarters of a turn, from the first axis to the second.
    pub quarters: u8,
    /// The displacement after that.
    pub shift: Point,
}

impl Place {
    /// Where a point of the piece comes to lie.
    pub fn apply(&self, p: Point) -> Point {
        let [x, y] = turned(p, self.quarters);
        [x + self.shift[0], y + self.shift[1]]
    }
}

fn turned([x, y]: Point, quarters: u8) -> Point {
    match quarters % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// Cells for the side of a piece, and for those of more than so many.
const CELLS: f64 = 100.0;
const COARSE_CELLS: f64 = 60.0;
const FINE: usize = 100;

/// Largest number of cells of a sheet.
const MOST_CELLS: f64 = 4e8;

/// The number of candidates for the next piece times that of all pieces is about this at most.
const CHOICES: usize = 1600;

/// Tries for one piece, and at least and at most for all.
const TRIES: usize = 1200;
const FEWEST_TRIES: usize = 4;
const MOST_TRIES: usize = 24;

/// Beyond this number of pieces, gaps are looked for only so many sides of a piece below where the last pieces went.
const MANY: usize = 200;
const DOWN: f64 = 3.0;

/// The side of a square on which pieces certainly have room, relative to that of one as large as the boxes around all.
const ROOM: f64 = 3.0;

/// Packs the pieces of a puzzle on a sheet.
///
/// # Definition
/// The path of a piece is its outline, moved outwards by half the cut. Pieces are turned by quarters and moved, not mirrored, so that the
/// paths of any two are at least a cut apart, and half a cut from the edges of the sheet: what is cut away around one piece touches no other.
/// They lie as near to one edge as a greedy choice leaves them.
///
/// # Accuracy
/// Pieces take all cells of a grid that are within that distance, and no cell is taken twice: distances hold to rounding.
///
/// # Errors
/// [`PuzzleError::Sheet`] with the largest number of pieces that was placed, if that is not all; none of the tries may be the best there is.
///
/// # Cost
/// For each piece and each of up to 48 candidates, the rows of cells near its place, each with some tens of looks; from 4 tries for many pieces to 24 for few, until one has room for all.
pub fn pack(puzzle: &Puzzle, sheet: [f64; 2], kerf: f64, control: &Control) -> Result<Packing, PuzzleError> {
    let pieces = puzzle.pieces();
    let paths: Vec<Vec<Point>> = (0..pieces).map(|piece| path(puzzle, piece, kerf)).collect();
    let packers = [true, false].map(|is_along| Packer::new(&paths, puzzle.unit(), sheet, kerf, is_along));
    let mut most = 0;
    for number in 0..(TRIES / pieces).clamp(FEWEST_TRIES, MOST_TRIES) {
        if number > 0 && control.is_stopped() {
            break;
        }
        let is_along = number % 2 == 0;
        let found = packers[number % 2].pack(&Try::number(number / 2), control);
        let count = found.iter().flatten().count();
        most = most.max(count);
        if count == pieces {
            let places: Vec<Place> = found.into_iter().flatten().collect();
            let area: f64 = (0..pieces).map(|piece| puzzle.area(piece)).sum();
            let axis = usize::from(is_along == (sheet[0] < sheet[1]));
            let end = (0..pieces)
                .flat_map(|piece| paths[piece].iter().map(move |p| (piece, *p)))
                .map(|(piece, p)| places[piece].apply(p)[axis])
                .fold(0.0, f64::max);
            let [used, filled] = [sheet[0] * sheet[1], end * sheet[1 - axis]].map(|whole| area / whole);
            return Ok(Packing { sheet, used, filled, places });
        }
    }
    Err(PuzzleError::Sheet { width: sheet[0], height: sheet[1], gap: kerf, fits: most, pieces })
}

/// The outline of a piece, moved outwards by half the cut.
pub(crate) fn path(puzzle: &Puzzle, piece: usize, kerf: f64) -> Vec<Point> {
    let points = puzzle.outline(piece);
    let outline = (kerf > 0.0).then(|| Outline::new(points.clone()).ok()).flatten();
    let grown = outline.map(|outline| offset(&outline, 0.5 * kerf)).unwrap_or_default();
    let largest = grown.into_iter().max_by(|a, b| a.area().total_cmp(&b.area()));
    largest.map_or(points, Outline::into_points)
}

/// How one try packs.
struct Try {
    /// Whether the lower last row makes a place better, instead of the lower mean row.
    is_by_top: bool,
    /// Pieces of which the one that fits best comes next.
    choice: usize,
    /// Shuffles pieces of similar size.
    seed: u64,
}

impl Try {
    fn number(number: usize) -> Self {
        let choices = [16, 4, 48, 8, 1, 24];
        Self {
            is_by_top: number % 2 == 1,
            choice: choices[number / 2 % choices.len()],
            seed: number as u64 / 12,
        }
    }

    /// The pieces, those with more cells first; for seeds above 0 sizes count with an error of up to a quarter.
    fn order(&self, masks: &[[Mask; 4]]) -> Vec<usize> {
        let key = |piece: usize| {
            let [x, y] = masks[piece][0].size;
            // The last bits of a product with an odd number are as good as random here.
            let mixed =
                (piece as u64 + 1).wrapping_mul(2 * self.seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let share = if self.seed == 0 { 0.0 } else { (mixed >> 11) as f64 / (1_u64 << 53) as f64 };
            (x * y) as f64 * (1.0 + 0.25 * share)
        };
        let mut order: Vec<usize> = (0..masks.len()).collect();
        order.sort_by(|i, j| key(*j).total_cmp(&key(*i)).then(i.cmp(j)));
        order
    }
}

/// Pieces to pack, by masks for each quarter of a turn, on a sheet that is filled from its first row.
struct Packer {
    masks: Vec<[Mask; 4]>,
    cells: Cells,
    side: f64,
    /// Cells in the side of a piece.
    unit: f64,
    /// Whether rows of cells lie along the second axis of the sheet.
    is_turned: bool,
}

impl Packer {
    fn new(paths: &[Vec<Point>], unit: f64, sheet: [f64; 2], kerf: f64, is_along: bool) -> Self {
        let extent = |path: &[Point], k: usize| {
            let [low, high] = path
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[k]), high.max(p[k])]);
            high - low + kerf
        };
        let extents: Vec<[f64; 2]> = paths.iter().map(|path| [extent(path, 0), extent(path, 1)]).collect();
        let is_turned = is_along == (sheet[0] >= sheet[1]);
        let [across, up] = if is_turned { [sheet[1], sheet[0]] } else { sheet };
        // Of a sheet much larger than the pieces, only a part is looked at.
        let longest = extents.iter().flatten().copied().fold(0.0, f64::max);
        let room = ROOM * longest.max(extents.iter().map(|[x, y]| x * y).sum::<f64>().sqrt());
        let across = across.min(room + room * room / up.min(room));
        let up = up.min(room + room * room / across.min(room));
        let cells = if paths.len() > FINE { COARSE_CELLS } else { CELLS };
        let side = (unit / cells).max((across * up / MOST_CELLS).sqrt());
        let turn = |path: &[Point], quarters: u8| -> Vec<Point> {
            path.iter().map(|p| turned(*p, quarters)).collect()
        };
        let all = |path: &Vec<Point>| {
            [0, 1, 2, 3].map(|quarters| Mask::new(&turn(path, quarters), 0.5 * kerf, side))
        };
        let size = [across, up].map(|length| (length / side * (1.0 + 1e-12)).floor() as usize);
        Self {
            masks: paths.par_iter().map(all).collect(),
            cells: Cells::new(size),
            side,
            unit: unit / side,
            is_turned,
        }
    }

    /// The place of each piece; none for those that find no room.
    fn pack(&self, how: &Try, control: &Control) -> Vec<Option<Place>> {
        let pieces = self.masks.len();
        let choice = how.choice.min(CHOICES / pieces).max(1);
        let mut cells = self.cells.clone();
        let mut places = vec![None; pieces];
        let mut open: Vec<usize> = how.order(&self.masks).into_iter().rev().collect();
        let mut from = 0;
        while !open.is_empty() && !control.is_stopped() {
            let candidates = &open[open.len().saturating_sub(choice)..];
            let turns: Vec<(usize, usize)> =
                candidates.iter().rev().flat_map(|piece| (0..4).map(|turn| (*piece, turn))).collect();
            let found: Vec<Option<[usize; 2]>> =
                turns.par_iter().map(|(piece, turn)| cells.place(&self.masks[*piece][*turn], from)).collect();
            let row = |mask: &Mask, y: usize| {
                if how.is_by_top { (y + mask.size[1]) as f64 } else { y as f64 + mask.height }
            };
            let placed = turns.iter().zip(found).filter_map(|((piece, turn), place)| {
                let at = place?;
                Some((row(&self.masks[*piece][*turn], at[1]), at, *piece, *turn))
            });
            let best = placed.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let Some((_, at, piece, turn)) = best else {
                // None of these has room; others may have.
                open.truncate(open.len() - candidates.len());
                from = 0;
                continue;
            };
            let mask = &self.masks[piece][turn];
            cells.take(mask, at);
            if pieces > MANY {
                from = at[1].saturating_sub((DOWN * self.unit) as usize);
            }
            places[piece] = Some(self.placed(turn as u8, mask, at));
            open.retain(|other| *other != piece);
        }
        places
    }

    fn placed(&self, turn: u8, mask: &Mask, at: [usize; 2]) -> Place {
        let shift = [0, 1].map(|k| at[k] as f64 * self.side - mask.low[k]);
        if !self.is_turned {
            return Place { quarters: turn, shift };
        }
        // The whole arrangement, by a quarter of a turn back.
        let [x, y] = turned(shift, 3);
        Place { quarters: (turn + 3) % 4, shift: [x, y + self.cells.size()[0] as f64 * self.side] }
    }
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
    fn pieces_lie_on_the_sheet_a_cut_apart() {
        for (layout, tab, pieces, kerf, sheet, least) in [
            (Layout::Grid, Tab::Knob, 24, 0.3, [400.0, 245.0], 0.6),
            (Layout::Grid, Tab::None, 24, 0.3, [209.0, 330.0], 0.85),
            (Layout::Voronoi, Tab::Dovetail, 30, 1.0, [250.0, 445.0], 0.53),
            (Layout::Hexagons, Tab::Knob, 20, 0.0, [5000.0, 250.0], 0.0),
        ] {
            let options = PuzzleOptions { pieces, layout, tab, ..PuzzleOptions::default() };
            let puzzle = make(&options).unwrap();
            let packing = pack(&puzzle, sheet, kerf, &Control::default()).unwrap();
            check(&puzzle, &packing, kerf);
            assert!(packing.used >= least, "{layout:?}: {}", packing.used);
            assert!(packing.filled >= 0.53, "{layout:?}: {}", packing.filled);
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
            Err(PuzzleError::Sheet { fits, pieces: 6, .. }) => fits,
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
