//! The cutting order of borders.

use crate::Puzzle;
use pompeiu_planar::Point;

/// A border to cut, and whether it is cut from its end to its start.
pub(crate) type Cut = (usize, bool);

/// The borders in an order that keeps pieces in place, each starting at its nearer end: those between pieces first, then the
/// outline.
///
/// # Definition
/// Uncut borders join pieces with each other and, along the outline, with the sheet. Borders of a spanning tree of that graph,
/// rooted in the sheet, may be cut only after all other borders of the piece at their far end; all others at any time. So anything
/// loose is one piece that is completely cut: no border of it is cut after it can move. Among the borders that may be cut, the
/// nearest comes next.
///
/// # Cost
/// The square of the number of borders.
pub(crate) fn cutting_order(puzzle: &Puzzle) -> Vec<Cut> {
    let n = puzzle.pieces();
    let borders = puzzle.borders();
    let parent = tree(puzzle);
    let mut uncut = vec![0_usize; n];
    for border in borders {
        uncut[border.left] += 1;
        border.right.into_iter().for_each(|right| uncut[right] += 1);
    }
    let child: Vec<Option<usize>> = {
        let mut child = vec![None; borders.len()];
        for (piece, border) in parent.iter().enumerate() {
            if let Some(border) = border {
                child[*border] = Some(piece);
            }
        }
        child
    };
    let ends: Vec<[Point; 2]> = borders
        .iter()
        .map(|border| [border.corners[0], border.corners[border.corners.len() - 1]].map(|c| puzzle.point(c)))
        .collect();
    let mut left: Vec<usize> = (0..borders.len()).collect();
    let mut order = Vec::with_capacity(left.len());
    let mut at = [0.0, 0.0];
    while !left.is_empty() {
        let is_inside_left = left.iter().any(|b| borders[*b].right.is_some() && is_free(child[*b], &uncut));
        let may = |b: usize| is_free(child[b], &uncut) && (borders[b].right.is_some() || !is_inside_left);
        let away = |p: Point| libm::hypot(p[0] - at[0], p[1] - at[1]);
        let near = |k: usize| ends[left[k]].map(away).into_iter().fold(f64::INFINITY, f64::min);
        let next = (0..left.len()).filter(|k| may(left[*k])).min_by(|a, b| near(*a).total_cmp(&near(*b)));
        // A tree always has a leaf.
        let border = left.swap_remove(next.unwrap_or(0));
        let is_reversed = away(ends[border][1]) < away(ends[border][0]);
        at = ends[border][usize::from(!is_reversed)];
        order.push((border, is_reversed));
        uncut[borders[border].left] -= 1;
        borders[border].right.into_iter().for_each(|right| uncut[right] -= 1);
    }
    order
}

/// Whether a border may be cut: it is not in the tree, or is the last border of the piece at its far end.
fn is_free(child: Option<usize>, uncut: &[usize]) -> bool {
    child.is_none_or(|piece| uncut[piece] == 1)
}

/// For each piece the border towards the sheet: along the outline, or to the neighbour one step nearer.
fn tree(puzzle: &Puzzle) -> Vec<Option<usize>> {
    let mut parent: Vec<Option<usize>> = vec![None; puzzle.pieces()];
    let mut front = std::collections::VecDeque::new();
    for (i, border) in puzzle.borders().iter().enumerate().filter(|(_, border)| border.right.is_none()) {
        if parent[border.left].is_none() {
            parent[border.left] = Some(i);
            front.push_back(border.left);
        }
    }
    while let Some(piece) = front.pop_front() {
        for (border, is_reversed) in &puzzle.loops[piece] {
            let of = &puzzle.borders()[*border];
            let other = if *is_reversed { Some(of.left) } else { of.right };
            if let Some(other) = other.filter(|other| parent[*other].is_none()) {
                parent[other] = Some(*border);
                front.push_back(other);
            }
        }
    }
    parent
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Layout, PuzzleOptions, make};
    use std::collections::BTreeSet;

    #[test]
    fn what_is_loose_is_cut_all_round() {
        for (layout, pieces) in [(Layout::Grid, 40), (Layout::Voronoi, 60)] {
            let puzzle =
                make(&PuzzleOptions { layout, pieces, seed: 2, ..PuzzleOptions::default() }).unwrap();
            let order = cutting_order(&puzzle);
            let mut is_cut = vec![false; puzzle.borders().len()];
            let (mut outline_begun, mut inside_after) = (false, 0);
            for (border, _) in &order {
                assert!(!std::mem::replace(&mut is_cut[*border], true));
                let is_outline = puzzle.borders()[*border].right.is_none();
                outline_begun |= is_outline;
                inside_after += usize::from(outline_begun && !is_outline);
                // The pieces that the sheet still holds.
                let mut held: BTreeSet<usize> = BTreeSet::new();
                loop {
                    let before = held.len();
                    for (i, of) in puzzle.borders().iter().enumerate().filter(|(i, _)| !is_cut[*i]) {
                        let _ = i;
                        match of.right {
                            None => {
                                held.insert(of.left);
                            }
                            Some(right) if held.contains(&of.left) || held.contains(&right) => {
                                held.extend([of.left, right]);
                            }
                            Some(_) => (),
                        }
                    }
                    if held.len() == before {
                        break;
                    }
                }
                for piece in (0..pieces).filter(|piece| !held.contains(piece)) {
                    assert!(puzzle.loops[piece].iter().all(|(b, _)| is_cut[*b]), "{layout:?}: piece {piece}");
                }
            }
            assert!(order.len() == is_cut.len() && inside_after == 0, "{layout:?}: {inside_after}");
        }
    }
}
