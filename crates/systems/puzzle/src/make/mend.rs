//! Necks of cells that borders make where they run along a thin part of an outline: the part is given to the piece across the border.

use super::clip::Graph;
use crate::Puzzle;
use crate::neck::Neck;
use crate::space::Corner;
use pompeiu_planar::{Point, distance_sq_to_segment};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The largest number of cuts that are tried, and of pieces that are looked at for narrow necks in all of them.
const MOST: usize = 100;
const LOOKS: usize = 10_000;

/// Cuts pieces at necks below a width, the narrowest first, and gives the smaller part to the neighbour with which it has the longest common
/// border, where fewer or wider necks are left by that. The number of pieces stays. Necks of the outline itself stay, too.
pub(crate) fn mended(mut puzzle: Puzzle, least: f64) -> Puzzle {
    if !puzzle.whimsies.is_empty() {
        return puzzle;
    }
    let mut given_up: Vec<[Point; 2]> = Vec::new();
    let mut necks = narrow(&puzzle, least);
    for _ in 0..MOST.min(LOOKS / puzzle.pieces()) {
        let open = necks.iter().filter(|(_, neck)| !given_up.contains(&neck.ends));
        let Some((piece, neck)) = open.min_by(|a, b| a.1.width.total_cmp(&b.1.width)) else { break };
        let changed = parted(&puzzle, *piece, neck).map(|changed| (narrow(&changed, least), changed));
        let missing =
            |necks: &[(usize, Neck)]| necks.iter().map(|(_, neck)| 1.0 - neck.width / least).sum::<f64>();
        match changed.filter(|(after, _)| missing(after) < missing(&necks)) {
            Some((after, changed)) => (necks, puzzle) = (after, changed),
            None => given_up.push(neck.ends),
        }
    }
    puzzle
}

/// The pieces with a neck below a width.
fn narrow(puzzle: &Puzzle, least: f64) -> Vec<(usize, Neck)> {
    let necks = (0..puzzle.pieces()).into_par_iter().filter_map(|piece| Some((piece, puzzle.neck(piece)?)));
    necks.filter(|(_, neck)| neck.width < least).collect()
}

/// The puzzle after a piece is cut at a neck and the smaller part given to a neighbour; none if the part has no other neighbour, or the corners of
/// the cut coincide on the lattice.
fn parted(puzzle: &Puzzle, piece: usize, neck: &Neck) -> Option<Puzzle> {
    // Directed sides, and whether each is one of the outline and one of the piece.
    let mut sides: Vec<([Corner; 2], [bool; 2])> = Vec::new();
    for border in &puzzle.borders {
        let is_own = border.left == piece || border.right == Some(piece);
        let of = [border.right.is_none(), is_own];
        sides.extend(border.corners.windows(2).map(|pair| ([pair[0], pair[1]], of)));
    }
    let ends = neck.ends.map(|end| end.map(|x| (x / puzzle.step).round() as i64));
    if ends[0] == ends[1] {
        return None;
    }
    for end in ends {
        if sides.iter().any(|(side, [_, is_own])| *is_own && side.contains(&end)) {
            continue;
        }
        let p = end.map(|x| x as f64);
        let away =
            |side: &[Corner; 2]| distance_sq_to_segment(p, side.map(|corner| corner.map(|x| x as f64)));
        let own = (0..sides.len()).filter(|i| sides[*i].1[1]);
        let nearest = own.min_by(|i, j| away(&sides[*i].0).total_cmp(&away(&sides[*j].0)))?;
        let ([a, b], of) = sides[nearest];
        sides[nearest] = ([a, end], of);
        sides.push(([end, b], of));
    }
    let outer =
        sides.iter().filter(|(_, [is_outer, _])| *is_outer).map(|(side, _)| *side).collect::<Vec<_>>();
    let mut edges: Vec<[Corner; 2]> = sides.into_iter().map(|(side, _)| side).collect();
    let cut = edges.len();
    edges.push(ends);
    let mut graph = Graph::of_edges(edges, &outer);
    let faces = graph.faces().ok()?;
    let owner = graph.owners(&faces);
    let [one, other] = [owner[2 * cut]?, owner[2 * cut + 1]?];
    let (small, rest) = if faces[one].doubled < faces[other].doubled { (one, other) } else { (other, one) };
    let mut shared: BTreeMap<usize, f64> = BTreeMap::new();
    for half in &faces[small].halves {
        if let Some(beside) = owner[half ^ 1].filter(|beside| *beside != small && *beside != rest) {
            *shared.entry(beside).or_default() += graph.length(*half);
        }
    }
    let (&into, _) = shared.iter().max_by(|a, b| a.1.total_cmp(b.1))?;
    graph.remove(|half| owner[half] == Some(small) && owner[half ^ 1] == Some(into));
    let faces = graph.faces().ok()?;
    (faces.len() == puzzle.pieces()).then(|| graph.puzzle(&faces, puzzle.step, puzzle.size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tooth_that_a_border_splits_goes_to_one_piece() {
        let around =
            [[0, 0], [42, 0], [100, 0], [100, 20], [50, 20], [50, 80], [42, 80], [40, 80], [40, 20], [0, 20]];
        let outline: Vec<[Corner; 2]> =
            (0..around.len()).map(|i| [around[i], around[(i + 1) % around.len()]]).collect();
        let edges = outline.iter().copied().chain([[[42, 0], [42, 80]]]).collect();
        let mut graph = Graph::of_edges(edges, &outline);
        let faces = graph.faces().unwrap();
        let split = graph.puzzle(&faces, 1.0, [100, 80]);
        let least = |puzzle: &Puzzle| {
            let necks = (0..puzzle.pieces()).filter_map(|piece| puzzle.neck(piece));
            necks.map(|neck| neck.width).fold(f64::INFINITY, f64::min)
        };
        assert_eq!((split.pieces(), least(&split)), (2, 2.0));
        let whole = mended(split.clone(), 6.0);
        assert_eq!((whole.pieces(), whole.outline_area()), (2, split.outline_area()));
        assert!(least(&whole) >= 6.0, "{}", least(&whole));
        let areas: f64 = (0..2).map(|piece| whole.area(piece)).sum();
        assert_eq!(areas, whole.outline_area());
        assert_eq!(mended(split.clone(), 1.9), split, "necks that are wide enough stay");
    }
}
