//! Whether pieces still hold each other after a cut of some width.

mod depths;
mod pair;

use crate::Puzzle;
use pair::{CELLS, Pair};
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, offset};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The effect of a cut of some width on a puzzle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Kerf {
    /// The width of the cut.
    pub width: f64,
    /// Whether no piece can leave the others in the plane, shown by pairs of pieces that cannot part even in isolation and connect
    /// all pieces. `false` if that is not shown.
    pub holds: bool,
    /// The widest of the cuts tried that holds: this width times 1, 2, 4 or 8, of which the wider ones are tried less finely, above all
    /// for more than 100 pieces; `null` if this width is not shown to hold.
    pub widest: Option<f64>,
    /// Clusters of pieces that are shown to hold each other.
    pub clusters: Vec<Vec<usize>>,
    /// Pieces that the cut removes completely or splits.
    pub split: Vec<usize>,
}

/// Multiples of the width that are tried.
const WIDER: [f64; 3] = [2.0, 4.0, 8.0];

/// Beyond this number of pieces wider cuts are tried with the largest cells alone.
const MANY: usize = 100;

/// Pieces that are tried alone before all pairs are.
const TRIED_ALONE: usize = 4;

/// Tests whether pieces hold each other after a cut along the borders that removes half its width on each side.
///
/// # Definition
/// Two pieces hold each other if no path of planar motions, rotations included, separates them without overlap. Pieces that hold
/// each other form one cluster: it has play, but does not come apart. A puzzle with one cluster holds.
///
/// # Accuracy
/// For finite motions, not only to first order: see `pair.rs`. A positive result is proven; a negative one is not, because pairs of
/// pieces are tested in isolation, and at a few resolutions only.
///
/// # Cost
/// For each of about as many pairs as pieces, a hundred to sixty thousand configurations, each with the number of points of the common
/// border, tested in groups of four; and for each piece the depth of some thousands of squares.
pub fn kerf(puzzle: &Puzzle, width: f64, control: &Control) -> Kerf {
    let clusters = clusters(puzzle, width, &CELLS, control);
    let holds = clusters.len() == 1;
    let mut widest = holds.then_some(width);
    if holds {
        // A search with smaller cells costs eight times as much.
        let wider_cells = if puzzle.pieces() > MANY { &CELLS[..1] } else { &CELLS[..3] };
        let wider = WIDER.map(|factor| factor * width);
        let tried = wider.into_iter().take_while(|w| {
            !control.is_stopped()
                && *w < 0.2 * puzzle.unit()
                && !comes_off(puzzle, *w, wider_cells, control)
                && self::clusters(puzzle, *w, wider_cells, control).len() == 1
        });
        widest = tried.last().or(widest);
    }
    let is_split = |piece: &usize| {
        Outline::new(puzzle.outline(*piece)).is_ok_and(|outline| offset(&outline, -0.5 * width).len() != 1)
    };
    let split = (0..puzzle.pieces()).into_par_iter().filter(is_split).collect();
    Kerf { width, holds, widest, clusters, split }
}

/// Neighbours, each with their common borders; not those with one straight border, which holds nothing.
fn neighbours(puzzle: &Puzzle) -> Vec<([usize; 2], Vec<usize>)> {
    let mut shared: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (i, border) in puzzle.borders().iter().enumerate() {
        let Some(right) = border.right else { continue };
        shared.entry([border.left.min(right), border.left.max(right)]).or_default().push(i);
    }
    // Pairs with the most corners first, because they have tabs.
    let mut found: Vec<([usize; 2], Vec<usize>)> = shared.into_iter().collect();
    let corners =
        |borders: &[usize]| borders.iter().map(|b| puzzle.borders()[*b].corners.len()).sum::<usize>();
    found.sort_by_key(|(pair, borders)| (std::cmp::Reverse(corners(borders)), *pair));
    found.retain(|(_, borders)| corners(borders) > 2);
    found
}

/// Whether one of the pieces with the fewest neighbours is held by none of them. Then there are several clusters, which testing all
/// pairs would find much later.
fn comes_off(puzzle: &Puzzle, width: f64, cells: &[f64], control: &Control) -> bool {
    let pairs = neighbours(puzzle);
    let of = |piece: usize| pairs.iter().filter(move |(pair, _)| pair.contains(&piece));
    let mut neighbours = vec![0_usize; puzzle.pieces()];
    pairs.iter().flat_map(|(pair, _)| pair).for_each(|piece| neighbours[*piece] += 1);
    let mut pieces: Vec<usize> = (0..puzzle.pieces()).collect();
    pieces.sort_by_key(|piece| neighbours[*piece]);
    pieces[..pieces.len().min(TRIED_ALONE)].par_iter().any(|piece| {
        !of(*piece).any(|(pair, borders)| {
            Pair::new(puzzle, *pair, borders, width).is_some_and(|mut pair| pair.holds(cells, control))
        })
    })
}

/// Clusters of pieces that hold each other, connected by pairs that do.
fn clusters(puzzle: &Puzzle, width: f64, cells: &[f64], control: &Control) -> Vec<Vec<usize>> {
    let mut held = Clusters::new(puzzle.pieces());
    let mut open = neighbours(puzzle);
    while !open.is_empty() && !control.is_stopped() {
        // Pairs that connect all if each of them holds; the others are needed only if some do not.
        let mut joined = held.clone();
        let (now, later): (Vec<_>, Vec<_>) = open
            .into_iter()
            .filter(|(pair, _)| held.of(pair[0]) != held.of(pair[1]))
            .partition(|(pair, _)| joined.join(*pair));
        let holds = |(pair, borders): &(_, Vec<usize>)| {
            Pair::new(puzzle, *pair, borders, width).is_some_and(|mut p| p.holds(cells, control))
        };
        let holding: Vec<bool> = now.par_iter().map(holds).collect();
        for ((pair, _), _) in now.iter().zip(holding).filter(|(_, holds)| *holds) {
            held.join(*pair);
        }
        open = later;
    }
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for piece in 0..puzzle.pieces() {
        found.entry(held.of(piece)).or_default().push(piece);
    }
    found.into_values().collect()
}

/// Disjoint sets of pieces, each called by its first piece.
#[derive(Clone)]
struct Clusters {
    /// An earlier piece of the same set, or the piece itself.
    earlier: Vec<usize>,
}

impl Clusters {
    fn new(pieces: usize) -> Self {
        Self { earlier: (0..pieces).collect() }
    }

    fn of(&mut self, mut piece: usize) -> usize {
        while self.earlier[piece] != piece {
            self.earlier[piece] = self.earlier[self.earlier[piece]];
            piece = self.earlier[piece];
        }
        piece
    }

    /// Joins the sets of two pieces; whether they were two.
    fn join(&mut self, pair: [usize; 2]) -> bool {
        let [a, b] = pair.map(|piece| self.of(piece));
        self.earlier[a.max(b)] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Border, Layout, PuzzleOptions, Tab, make};
    use pompeiu_core::run::Limits;

    /// Two pieces side by side on a square of 1000 steps.
    fn two(middle: &[[i64; 2]]) -> Puzzle {
        let corners = [&[[500, 0]], middle, &[[500, 1000]]].concat();
        let [left, right] = [
            vec![[500, 1000], [0, 1000], [0, 0], [500, 0]],
            vec![[500, 0], [1000, 0], [1000, 1000], [500, 1000]],
        ];
        let border = |corners, left, right| Border { corners, left, right };
        Puzzle {
            borders: vec![border(corners, 0, Some(1)), border(left, 0, None), border(right, 1, None)],
            loops: vec![vec![(0, false), (1, false)], vec![(2, false), (0, true)]],
            step: 1.0,
            size: [1000, 1000],
            doubled_outline: 2_000_000,
            whimsies: Vec::new(),
        }
    }

    #[test]
    fn a_head_holds_while_it_is_wider_than_the_neck_by_twice_the_cut() {
        let control = Control::start(&Limits::default());
        // A dovetail with neck 200, head 300 and sides that rise by 1 in 4: the cut w takes (√17 + 1)/4 w/2 off each side of the
        // head's end and adds as much to each side of the neck, so that the head passes from w = 39 on.
        let dovetail = two(&[[500, 400], [700, 350], [700, 650], [500, 600]]);
        for (width, holds) in [(2.0, true), (20.0, true), (30.0, true), (42.0, false), (90.0, false)] {
            assert_eq!(kerf(&dovetail, width, &control).holds, holds, "{width}");
        }
        // Parallel sides do not hold, however narrow the cut.
        let parallel = two(&[[500, 400], [700, 400], [700, 600], [500, 600]]);
        assert!(!kerf(&parallel, 1.0, &control).holds);
        // A lock by roughness disappears with the cut, although the first-order test reports it as locked.
        let rough = two(&[[500, 490], [510, 485], [510, 515], [500, 510]]);
        assert!(crate::lock(&rough).is_locked());
        assert!(kerf(&rough, 1.0, &control).holds && !kerf(&rough, 10.0, &control).holds);
        let found = kerf(&dovetail, 10.0, &control);
        assert_eq!((found.widest, found.clusters, found.split), (Some(20.0), vec![vec![0, 1]], vec![]));
    }

    #[test]
    fn whole_puzzles_hold_with_their_gaps_and_thin_pieces_split() {
        let control = Control::start(&Limits::default());
        for tab in [Tab::Knob, Tab::Dovetail] {
            let puzzle =
                make(&PuzzleOptions { pieces: 6, tab, layout: Layout::Grid, ..PuzzleOptions::default() });
            let puzzle = puzzle.unwrap();
            let found = kerf(&puzzle, 0.2, &control);
            assert!(found.holds && found.split.is_empty(), "{tab:?}: {found:?}");
            assert!(!kerf(&puzzle, 0.2 * puzzle.unit(), &control).holds);
        }
        // The neck of a tab is 200 wide.
        let dovetail = two(&[[500, 400], [700, 350], [700, 650], [500, 600]]);
        assert!(kerf(&dovetail, 150.0, &control).split.is_empty());
        assert_eq!(kerf(&dovetail, 210.0, &control).split, [0]);
    }
}
