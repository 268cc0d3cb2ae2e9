//! Clipping cells to an outline: the faces of the planar subdivision of both.

use crate::space::Corner;
use crate::{Border, Puzzle, PuzzleError};
use pompeiu_core::mesh::UnionFind;
use pompeiu_planar::Outline;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// Faces below this share of the mean area are merged with the neighbour with which they share the longest border.
const SLIVER: f64 = 0.3;

/// The mean is that of at least as many faces as cells were wanted, and of at most so many times as many, or of these where the number of
/// parts is limited: otherwise an outline with many thin parts has a small mean first, so that each of its parts stays, and the mean grows
/// with all that is merged until everything is.
const MOST_FACES: usize = 2;

/// The parts of cells inside an outline and outside of whimsies, and the whimsies, as a puzzle without tabs. The outline must lie
/// inside the rectangle of the cells.
///
/// Where borders meet the outline, it gets a corner on the lattice, less than a step from its side. With more than `most` parts the smallest are
/// merged with neighbours. `wanted` is the number of cells within the outline.
///
/// # Errors
/// [`PuzzleError::Narrow`] if a border passes through a corner of the outline, or parts are too narrow for the lattice: moving the
/// sites may help.
pub(super) fn within(
    cells: &Puzzle,
    outline: &[Corner],
    whimsies: &[Vec<Corner>],
    [wanted, most]: [usize; 2],
) -> Result<Puzzle, PuzzleError> {
    let inner = cells.borders.iter().filter(|border| border.right.is_some());
    let segments = inner.map(|border| [border.corners[0], border.corners[1]]);
    let mut graph = Graph::of(segments, outline, whimsies)?;
    let faces = graph.faces()?;
    let whole = faces.iter().map(|face| face.doubled as f64).sum::<f64>();
    let is_one_too_many = |count: usize, doubled: i128| {
        let fewest = if most < usize::MAX { MOST_FACES * wanted } else { wanted };
        let mean = whole / count.clamp(fewest, MOST_FACES * wanted) as f64;
        count > 2 && (count > most || (doubled as f64) < SLIVER * mean)
    };
    let faces = graph.merged(faces, is_one_too_many)?.0;
    Ok(graph.puzzle(&faces, cells.step, cells.size))
}

/// The faces of segments within an outline, as a puzzle of at most `most` pieces: the smallest faces are merged with neighbours.
///
/// # Errors
/// As [`within`].
pub(crate) fn faces_within(
    segments: &[[Corner; 2]],
    outline: &[Corner],
    most: usize,
    step: f64,
    size: [i64; 2],
) -> Result<Puzzle, PuzzleError> {
    let mut graph = Graph::of(segments.iter().copied(), outline, &[])?;
    let faces = graph.faces()?;
    let faces = graph.merged(faces, |count, _| count > most)?.0;
    Ok(graph.puzzle(&faces, step, size))
}

/// Edges between corners; half-edge 2e runs from the first to the second end of edge e, 2e + 1 back.
pub(super) struct Graph {
    edges: Vec<[Corner; 2]>,
    is_alive: Vec<bool>,
    /// For each edge, the whimsy that it bounds.
    whimsy_of: Vec<Option<usize>>,
    /// Twice the area inside the outline.
    doubled: i128,
}

/// A face: its half-edges counter-clockwise, and twice its area.
pub(super) struct Face {
    pub(super) halves: Vec<usize>,
    pub(super) doubled: i128,
}

fn cross(a: Corner, b: Corner) -> i128 {
    i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0])
}

fn minus(a: Corner, b: Corner) -> Corner {
    [a[0] - b[0], a[1] - b[1]]
}

/// Segments without their parts outside (or inside) of a polygon, and the sides of the polygon, split where segments end on them.
fn parted(
    segments: impl Iterator<Item = [Corner; 2]>,
    polygon: &[Corner],
    keep_inside: bool,
) -> Result<[Vec<[Corner; 2]>; 2], PuzzleError> {
    let degenerate = PuzzleError::Narrow { piece: 0 };
    let as_points = polygon.iter().map(|c| c.map(|x| x as f64)).collect();
    let shape = Outline::new(as_points).map_err(|_| degenerate.clone())?;
    let n = polygon.len();
    let mut kept: Vec<[Corner; 2]> = Vec::new();
    let mut on_sides: Vec<Vec<(f64, Corner)>> = vec![Vec::new(); n];
    for [a, b] in segments {
        let mut places: Vec<(f64, Corner)> = Vec::new();
        for (i, side) in on_sides.iter_mut().enumerate() {
            let [c, d] = [polygon[i], polygon[(i + 1) % n]];
            let is_apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
            if is_apart(0) || is_apart(1) {
                continue;
            }
            let (u, v) = (minus(b, a), minus(d, c));
            let turns =
                [cross(u, minus(c, a)), cross(u, minus(d, a)), cross(v, minus(a, c)), cross(v, minus(b, c))];
            let meets = |x: i128, y: i128| x.signum() * y.signum() <= 0;
            let opposite = |x: i128, y: i128| x.signum() * y.signum() < 0;
            if turns.contains(&0) && meets(turns[0], turns[1]) && meets(turns[2], turns[3]) {
                return Err(degenerate);
            }
            if opposite(turns[0], turns[1]) && opposite(turns[2], turns[3]) {
                let t = turns[2] as f64 / (turns[2] - turns[3]) as f64;
                let s = turns[0] as f64 / (turns[0] - turns[1]) as f64;
                let place = [0, 1].map(|k| a[k] + (t * u[k] as f64).round() as i64);
                places.push((t, place));
                side.push((s, place));
            }
        }
        places.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut is_kept = shape.contains(a.map(|x| x as f64)) == keep_inside;
        let mut from = a;
        for to in places.into_iter().map(|(_, place)| place).chain([b]) {
            if is_kept && from != to {
                kept.push([from, to]);
            }
            is_kept = !is_kept;
            from = to;
        }
    }
    let mut sides = Vec::new();
    for (i, mut places) in on_sides.into_iter().enumerate() {
        places.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut from = polygon[i];
        for to in places.into_iter().map(|(_, place)| place).chain([polygon[(i + 1) % n]]) {
            if from != to {
                sides.push([from, to]);
            }
            from = to;
        }
    }
    Ok([kept, sides])
}

impl Graph {
    fn of(
        segments: impl Iterator<Item = [Corner; 2]>,
        outline: &[Corner],
        whimsies: &[Vec<Corner>],
    ) -> Result<Self, PuzzleError> {
        let [mut edges, sides] = parted(segments, outline, true)?;
        let doubled = sides.iter().map(|[a, b]| cross(*a, *b)).sum();
        let mut around = Vec::new();
        for (i, whimsy) in whimsies.iter().enumerate() {
            let [outside, sides] = parted(edges.into_iter(), whimsy, false)?;
            edges = outside;
            around.extend(sides.into_iter().map(|side| (side, Some(i))));
        }
        let mut whimsy_of = vec![None; edges.len() + sides.len()];
        edges.extend(sides);
        for (side, whimsy) in around {
            edges.push(side);
            whimsy_of.push(whimsy);
        }
        Ok(Self { is_alive: vec![true; edges.len()], edges, whimsy_of, doubled })
    }

    /// Edges that meet at their ends only, of which some are the sides of the outline, counter-clockwise.
    pub(super) fn of_edges(edges: Vec<[Corner; 2]>, outline: &[[Corner; 2]]) -> Self {
        let doubled = outline.iter().map(|[a, b]| cross(*a, *b)).sum();
        Self { is_alive: vec![true; edges.len()], whimsy_of: vec![None; edges.len()], edges, doubled }
    }

    /// The length of an edge.
    pub(super) fn length(&self, half: usize) -> f64 {
        let [x, y] = self.direction(half).map(|x| x as f64);
        libm::hypot(x, y)
    }

    /// Removes the edges of some half-edges.
    pub(super) fn remove(&mut self, is_removed: impl Fn(usize) -> bool) {
        for half in 0..2 * self.edges.len() {
            self.is_alive[half / 2] &= !is_removed(half);
        }
    }

    /// The whimsy that a face represents.
    fn whimsy(&self, face: &Face) -> Option<usize> {
        let first = self.whimsy_of[face.halves[0] / 2]?;
        let is_side = |half: &usize| half.is_multiple_of(2) && self.whimsy_of[half / 2] == Some(first);
        face.halves.iter().all(is_side).then_some(first)
    }

    fn tail(&self, half: usize) -> Corner {
        self.edges[half / 2][half % 2]
    }

    fn direction(&self, half: usize) -> Corner {
        minus(self.tail(half ^ 1), self.tail(half))
    }

    /// The faces inside: at each corner the traversal continues along the next edge clockwise.
    pub(super) fn faces(&mut self) -> Result<Vec<Face>, PuzzleError> {
        self.prune();
        let mut around: BTreeMap<Corner, Vec<usize>> = BTreeMap::new();
        for half in (0..2 * self.edges.len()).filter(|half| self.is_alive[half / 2]) {
            around.entry(self.tail(half)).or_default().push(half);
        }
        let mut next = vec![usize::MAX; 2 * self.edges.len()];
        for halves in around.values_mut() {
            halves.sort_by(|a, b| by_angle(self.direction(*a), self.direction(*b)));
            for (k, half) in halves.iter().enumerate() {
                let before = halves[(k + halves.len() - 1) % halves.len()];
                next[half ^ 1] = before;
            }
        }
        let mut seen = vec![false; next.len()];
        let (mut faces, mut outside) = (Vec::new(), 0);
        for start in (0..next.len()).filter(|half| self.is_alive[half / 2]) {
            if seen[start] {
                continue;
            }
            let (mut halves, mut doubled, mut at) = (Vec::new(), 0, start);
            while !seen[at] {
                seen[at] = true;
                halves.push(at);
                doubled += cross(self.tail(at), self.tail(at ^ 1));
                at = next[at];
            }
            match doubled.cmp(&0) {
                Ordering::Greater => faces.push(Face { halves, doubled }),
                Ordering::Less => outside += 1,
                Ordering::Equal => return Err(PuzzleError::Narrow { piece: faces.len() }),
            }
        }
        let sum: i128 = faces.iter().map(|face| face.doubled).sum();
        if outside == 1 && sum == self.doubled {
            Ok(faces)
        } else {
            Err(PuzzleError::Narrow { piece: faces.len() })
        }
    }

    /// Removes dangling edges.
    fn prune(&mut self) {
        loop {
            let mut degree: BTreeMap<Corner, usize> = BTreeMap::new();
            for end in (0..self.edges.len()).filter(|e| self.is_alive[*e]).flat_map(|e| self.edges[e]) {
                *degree.entry(end).or_default() += 1;
            }
            let loose: Vec<usize> = (0..self.edges.len())
                .filter(|e| self.is_alive[*e] && self.edges[*e].iter().any(|end| degree[end] == 1))
                .collect();
            if loose.is_empty() {
                return;
            }
            for e in loose {
                self.is_alive[e] = false;
            }
        }
    }

    /// The faces after the smallest one is merged with the neighbour with which it has the longest common border, as long as there is one too
    /// many: a function of the number of faces and twice the area of the smallest. A face between whimsies alone stays. Also the
    /// number of common borders that were looked at.
    fn merged(
        &mut self,
        faces: Vec<Face>,
        is_one_too_many: impl Fn(usize, i128) -> bool,
    ) -> Result<(Vec<Face>, usize), PuzzleError> {
        let owner = self.owners(&faces);
        let mut sharing = vec![BTreeMap::new(); faces.len()];
        let mut open = BTreeSet::new();
        for (f, face) in faces.iter().enumerate() {
            if self.whimsy(face).is_none() {
                open.insert((face.doubled, f));
            }
            for half in face.halves.iter().filter(|half| self.whimsy_of[**half / 2].is_none()) {
                if let Some(other) = owner[half ^ 1].filter(|other| *other != f) {
                    *sharing[f].entry(other).or_insert(0.0) += self.length(*half);
                }
            }
        }
        let mut doubled: Vec<i128> = faces.iter().map(|face| face.doubled).collect();
        let mut parts = UnionFind::new(faces.len());
        let (mut count, mut looks) = (faces.len(), 0);
        while let Some(&(area, small)) = open.first() {
            if !is_one_too_many(count, area) {
                break;
            }
            open.remove(&(area, small));
            looks += sharing[small].len();
            let longest = sharing[small].iter().max_by(|a, b| a.1.total_cmp(b.1));
            let Some(other) = longest.map(|(other, _)| *other) else { continue };
            open.remove(&(doubled[other], other));
            // The face with fewer neighbours goes into the other one.
            let is_first = sharing[small].len() > sharing[other].len();
            let (from, into) = if is_first { (other, small) } else { (small, other) };
            for (neighbour, length) in std::mem::take(&mut sharing[from]) {
                looks += 1;
                sharing[neighbour].remove(&from);
                if neighbour != into {
                    *sharing[neighbour].entry(into).or_insert(0.0) += length;
                    *sharing[into].entry(neighbour).or_insert(0.0) += length;
                }
            }
            parts.union(from, into);
            doubled[into] = doubled[small] + doubled[other];
            open.insert((doubled[into], into));
            count -= 1;
        }
        if count == faces.len() {
            return Ok((faces, looks));
        }
        for e in 0..self.edges.len() {
            let [left, right] = [owner[2 * e], owner[2 * e + 1]];
            let is_between = left.zip(right).is_some_and(|(a, b)| a != b && parts.find(a) == parts.find(b));
            if is_between && self.whimsy_of[e].is_none() {
                self.is_alive[e] = false;
            }
        }
        Ok((self.faces()?, looks))
    }

    /// The face on the left of each half-edge.
    pub(super) fn owners(&self, faces: &[Face]) -> Vec<Option<usize>> {
        let mut owner = vec![None; 2 * self.edges.len()];
        for (f, face) in faces.iter().enumerate() {
            face.halves.iter().for_each(|half| owner[*half] = Some(f));
        }
        owner
    }

    /// The faces as pieces, with edges between the same two faces joined to borders.
    pub(super) fn puzzle(&self, faces: &[Face], step: f64, size: [i64; 2]) -> Puzzle {
        let owner = self.owners(faces);
        let mut borders: Vec<Border> = Vec::new();
        let mut border_of = vec![usize::MAX; self.edges.len()];
        let mut loops = Vec::with_capacity(faces.len());
        for (f, face) in faces.iter().enumerate() {
            // Starts where the neighbour changes, so that no border starts in its middle.
            let n = face.halves.len();
            let other = |k: usize| owner[face.halves[k % n] ^ 1];
            let start = (0..n).find(|k| other(*k) != other(k + n - 1)).unwrap_or(0);
            let mut pieces: Vec<(usize, bool)> = Vec::new();
            for k in start..start + n {
                let half = face.halves[k % n];
                if border_of[half / 2] != usize::MAX {
                    let known = (border_of[half / 2], true);
                    if pieces.last() != Some(&known) {
                        pieces.push(known);
                    }
                    continue;
                }
                let is_new =
                    k == start || other(k) != other(k - 1) || self.is_junction(half, &borders, &pieces);
                if is_new {
                    borders.push(Border { corners: vec![self.tail(half)], left: f, right: other(k) });
                    pieces.push((borders.len() - 1, false));
                }
                let border = borders.len() - 1;
                borders[border].corners.push(self.tail(half ^ 1));
                border_of[half / 2] = border;
            }
            loops.push(pieces);
        }
        let whimsies = (0..faces.len()).filter(|f| self.whimsy(&faces[*f]).is_some()).collect();
        Puzzle { borders, loops, step, size, doubled_outline: self.doubled, whimsies }
    }

    /// Whether a border cannot be continued with the last one of a piece, because another piece made it.
    fn is_junction(&self, half: usize, borders: &[Border], pieces: &[(usize, bool)]) -> bool {
        let last = pieces.last().filter(|(_, is_reversed)| !is_reversed);
        last.is_none_or(|(border, _)| borders[*border].corners.last() != Some(&self.tail(half)))
    }
}

/// Counter-clockwise from the positive first axis, exactly.
fn by_angle(a: Corner, b: Corner) -> Ordering {
    let is_lower = |v: Corner| v[1] < 0 || (v[1] == 0 && v[0] < 0);
    is_lower(a).cmp(&is_lower(b)).then_with(|| 0.cmp(&cross(a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines of a grid within a rectangle.
    fn grid(side: i64) -> Graph {
        let long = 10 * side;
        let line = |i: i64| [[[10 * i, -5], [10 * i, long + 5]], [[-5, 10 * i], [long + 5, 10 * i]]];
        let parts = |[a, b]: [Corner; 2]| {
            let k = usize::from(a[0] == b[0]);
            let steps = (0..side).map(move |j| [10 * j, 10 * (j + 1)]);
            steps.map(move |ends| ends.map(|x| if k == 1 { [a[0], x] } else { [x, a[1]] }))
        };
        let segments: Vec<[Corner; 2]> = (0..=side).flat_map(line).flat_map(parts).collect();
        let outline = [[-7, -6], [long + 6, -6], [long + 6, long + 7], [-7, long + 7]];
        Graph::of(segments.into_iter(), &outline, &[]).unwrap()
    }

    #[test]
    fn merging_many_faces_looks_at_few_borders_for_each() {
        let mut graph = grid(60);
        // The faces of a graph that does not reach its outline are not those inside it: only the grid is looked at.
        graph.edges.truncate(2 * 60 * 61);
        graph.is_alive.truncate(2 * 60 * 61);
        graph.whimsy_of.truncate(2 * 60 * 61);
        graph.doubled = 2 * 600 * 600;
        let faces = graph.faces().unwrap();
        assert_eq!(faces.len(), 3600);
        let (merged, looks) = graph.merged(faces, |count, _| count > 40).unwrap();
        assert_eq!(merged.len(), 40);
        let sum: i128 = merged.iter().map(|face| face.doubled).sum();
        assert_eq!(sum, graph.doubled);
        let sizes = merged.iter().map(|face| face.doubled);
        assert!(sizes.clone().max() <= sizes.min().map(|least| 8 * least), "pieces of similar size");
        assert!(looks < 20 * 3600, "{looks}");
    }
}
