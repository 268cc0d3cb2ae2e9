//! A greedy choice of places, by the cells of a grid.

use super::mask::{Cells, Mask};
use pompeiu_core::run::Control;
use pompeiu_planar::{Point, bounds};
use rayon::prelude::*;

/// Cells for the side of a piece, and for those of more than so many.
const CELLS: f64 = 100.0;
const COARSE_CELLS: f64 = 60.0;
const FINE: usize = 100;

/// Largest number of cells of a sheet.
const MOST_CELLS: f64 = 4e8;

/// The number of candidates for the next piece times that of all pieces is about this at most.
const CHOICES: usize = 1600;

/// Beyond this number of pieces, gaps are looked for only so many sides of a piece below where the last pieces went.
const MANY: usize = 200;
const DOWN: f64 = 3.0;

/// The side of a square on which pieces certainly have room, relative to that of one as large as the boxes around all.
const ROOM: f64 = 3.0;

/// A piece turned by quarters of a turn, from the first axis to the second, then moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) quarters: u8,
    pub(super) shift: Point,
}

/// A point turned by quarters of a turn.
pub(super) fn turned([x, y]: Point, quarters: u8) -> Point {
    match quarters % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// How one try packs.
pub(super) struct Try {
    /// Whether the lower last row makes a place better, instead of the lower mean row.
    is_by_top: bool,
    /// Pieces of which the one that fits best comes next.
    choice: usize,
    /// Shuffles pieces of similar size.
    seed: u64,
}

impl Try {
    pub(super) fn number(number: usize) -> Self {
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
pub(super) struct Packer {
    /// Width of the part of the sheet that is looked at.
    pub(super) width: f64,
    masks: Vec<[Mask; 4]>,
    cells: Cells,
    side: f64,
    /// Cells in the side of a piece.
    unit: f64,
}

impl Packer {
    pub(super) fn new(paths: &[Vec<Point>], unit: f64, [across, up]: [f64; 2], kerf: f64) -> Self {
        let extents: Vec<[f64; 2]> = paths
            .iter()
            .map(|path| {
                let [low, high] = bounds(path);
                [0, 1].map(|k| high[k] - low[k] + kerf)
            })
            .collect();
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
            width: across,
            masks: paths.par_iter().map(all).collect(),
            cells: Cells::new(size),
            side,
            unit: unit / side,
        }
    }

    /// The place of each piece; none for those that find no room.
    pub(super) fn pack(&self, how: &Try, control: &Control) -> Vec<Option<Placed>> {
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

    fn placed(&self, turn: u8, mask: &Mask, at: [usize; 2]) -> Placed {
        let shift = [0, 1].map(|k| at[k] as f64 * self.side - mask.low[k]);
        Placed { quarters: turn, shift }
    }
}
