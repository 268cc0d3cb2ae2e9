//! What still holds once a cut has taken its width away.

mod pair;

use crate::Puzzle;
use pair::Pair;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, offset};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What a cut of some width leaves of a puzzle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Kerf {
    /// The width of the cut.
    pub width: f64,
    /// Whether no piece can leave the others in the plane, each two pieces by themselves being unable to part. `false` where that is not shown.
    pub holds: bool,
    /// The widest cut tried that holds, this width times 1, 2, 4 or 8; `null` where this one is not shown to hold.
    pub widest: Option<f64>,
    /// Pieces that are shown to hold each other.
    pub clusters: Vec<Vec<usize>>,
    /// Pieces of which the cut leaves nothing, or several parts.
    pub split: Vec<usize>,
}

/// Multiples of the width that are tried.
const WIDER: [f64; 3] = [2.0, 4.0, 8.0];

/// What a cut along the borders, half of its width on each side, leaves of a puzzle: whether pieces hold each other with the gap between them.
///
/// # Definition
/// Two pieces hold each other if no path of motions in the plane, turns included, takes one away from the other without the two going into each
/// other. Pieces that do are one cluster: it rattles, and does not come apart. A puzzle of one cluster holds.
///
/// # Accuracy
/// Finite, not to first order: see `pair.rs`. What is said to hold does; what is not said to hold may, for it is asked of each two pieces
/// alone, and at three resolutions only.
///
/// # Cost
/// For each of about as many pairs as pieces some hundred to ten thousand places, corners of both pieces squared for each.
pub fn kerf(puzzle: &Puzzle, width: f64, control: &Control) -> Kerf {
    let clusters = clusters(puzzle, width, control);
    let holds = clusters.len() == 1;
    let mut widest = holds.then_some(width);
    if holds {
        let wider = WIDER.map(|factor| factor * width);
        let tried = wider.into_iter().take_while(|w| {
            !control.is_stopped()
                && *w < 0.2 * puzzle.unit()
                && self::clusters(puzzle, *w, control).len() == 1
        });
        widest = tried.last().or(widest);
    }
    let is_split = |piece: &usize| {
        Outline::new(puzzle.outline(*piece)).is_ok_and(|outline| offset(&outline, -0.5 * width).len() != 1)
    };
    let split = (0..puzzle.pieces()).into_par_iter().filter(is_split).collect();
    Kerf { width, holds, widest, clusters, split }
}

/// Pieces that hold each other, by a forest of pairs that do.
fn clusters(puzzle: &Puzzle, width: f64, control: &Control) -> Vec<Vec<usize>> {
    let mut cluster: Vec<usize> = (0..puzzle.pieces()).collect();
    let mut shared: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (i, border) in puzzle.borders().iter().enumerate() {
        let Some(right) = border.right else { continue };
        shared.entry([border.left.min(right), border.left.max(right)]).or_default().push(i);
    }
    // Those with the most corners first: tabs are there.
    let mut open: Vec<([usize; 2], Vec<usize>)> = shared.into_iter().collect();
    let corners =
        |borders: &[usize]| borders.iter().map(|b| puzzle.borders()[*b].corners.len()).sum::<usize>();
    open.sort_by_key(|(pair, borders)| (std::cmp::Reverse(corners(borders)), *pair));
    open.retain(|(_, borders)| corners(borders) > 2);
    while !open.is_empty() && !control.is_stopped() {
        let mut joined = cluster.clone();
        let (mut now, mut later) = (Vec::new(), Vec::new());
        for (pair, borders) in open {
            let [a, b] = pair.map(|piece| joined[piece]);
            if cluster[pair[0]] == cluster[pair[1]] {
                continue;
            }
            if a == b {
                later.push((pair, borders));
            } else {
                joined.iter_mut().filter(|c| **c == b).for_each(|c| *c = a);
                now.push((pair, borders));
            }
        }
        let held: Vec<bool> = now
            .par_iter()
            .map(|(pair, borders)| Pair::new(puzzle, *pair, borders, width).is_some_and(|p| p.holds(control)))
            .collect();
        for ((pair, _), _) in now.iter().zip(held).filter(|(_, held)| *held) {
            let [a, b] = pair.map(|piece| cluster[piece]);
            cluster.iter_mut().filter(|c| **c == a.max(b)).for_each(|c| *c = a.min(b));
        }
        open = later;
    }
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (piece, of) in cluster.iter().enumerate() {
        found.entry(*of).or_default().push(piece);
    }
    found.into_values().collect()
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
        // A dovetail of neck 200 and head 300, whose sides rise by 1 in 4: the cut w takes (√17 + 1)/4 w/2 off each side of the head's end, and
        // as much is added to each side of the neck, so that the head passes from w = 39 on.
        let dovetail = two(&[[500, 400], [700, 350], [700, 650], [500, 600]]);
        for (width, holds) in [(2.0, true), (20.0, true), (30.0, true), (42.0, false), (90.0, false)] {
            assert_eq!(kerf(&dovetail, width, &control).holds, holds, "{width}");
        }
        // Parallel sides hold nothing, however narrow the cut.
        let parallel = two(&[[500, 400], [700, 400], [700, 600], [500, 600]]);
        assert!(!kerf(&parallel, 1.0, &control).holds);
        // A lock by roughness is gone with the cut, though the test of directions calls it locked.
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
