//! Pieces and their common borders, each stored once.

use crate::PuzzleError;
use crate::space::{Corner, Space};
use pompeiu_planar::Point;
use std::collections::BTreeMap;

/// A border between two pieces, or between a piece and the outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Border {
    /// Its corners on the lattice, ends included.
    pub(crate) corners: Vec<Corner>,
    /// The piece on its left.
    pub left: usize,
    /// The piece on its right; `None` on the outline.
    pub right: Option<usize>,
}

/// A puzzle: borders, each stored once, and the pieces that they bound.
///
/// Corners have integer coordinates on a lattice, at most 2^22 steps across; [`Puzzle::step`] is its step in the unit of the
/// outline. So areas are exact, and common borders of two pieces are identical bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Puzzle {
    pub(crate) borders: Vec<Border>,
    /// For each piece its borders counter-clockwise, and whether each is reversed.
    pub(crate) loops: Vec<Vec<(usize, bool)>>,
    pub(crate) step: f64,
    pub(crate) size: [i64; 2],
    /// Twice the area of the outline, in steps squared.
    pub(crate) doubled_outline: i128,
    /// Pieces that have an outline of their own.
    pub(crate) whimsies: Vec<usize>,
}

impl Puzzle {
    /// The number of pieces.
    pub fn pieces(&self) -> usize {
        self.loops.len()
    }

    /// The pieces with given outlines, see [`crate::PuzzleOptions::whimsies`].
    pub fn whimsies(&self) -> &[usize] {
        &self.whimsies
    }

    /// The puzzle of some pieces: borders to the others become part of the outline. `None` if these pieces are not connected or
    /// have holes.
    pub(crate) fn of_pieces(&self, pieces: &[usize]) -> Option<Self> {
        let mut number = vec![None; self.pieces()];
        for (new, old) in pieces.iter().enumerate() {
            number[*old] = Some(new);
        }
        let mut borders = Vec::new();
        let mut name = vec![None; self.borders.len()];
        for (i, border) in self.borders.iter().enumerate() {
            let (left, right) = (number[border.left], border.right.and_then(|right| number[right]));
            let (left, right, is_turned) = match (left, right) {
                (Some(left), right) => (left, right, false),
                (None, Some(right)) => (right, None, true),
                (None, None) => continue,
            };
            let mut corners = border.corners.clone();
            if is_turned {
                corners.reverse();
            }
            name[i] = Some((borders.len(), is_turned));
            borders.push(Border { corners, left, right });
        }
        let of = |piece: &usize| {
            self.loops[*piece].iter().filter_map(|(border, is_reversed)| {
                name[*border].map(|(new, is_turned)| (new, *is_reversed != is_turned))
            })
        };
        let loops = pieces.iter().map(|piece| of(piece).collect()).collect();
        let mut kept = Self {
            borders,
            loops,
            step: self.step,
            size: self.size,
            doubled_outline: 0,
            whimsies: Vec::new(),
        };
        let around: Vec<Corner> =
            kept.outer().into_iter().map(|p| p.map(|x| (x / self.step).round() as i64)).collect();
        kept.doubled_outline = doubled(&around);
        let sum: i128 = (0..kept.pieces()).map(|piece| kept.doubled_area(piece)).sum();
        (sum == kept.doubled_outline).then_some(kept)
    }

    /// The borders.
    pub fn borders(&self) -> &[Border] {
        &self.borders
    }

    /// The distance of neighbours on the lattice, in the unit of the outline.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Width and height of the rectangle that holds the puzzle, in the unit of the outline.
    pub fn size(&self) -> [f64; 2] {
        self.size.map(|x| x as f64 * self.step)
    }

    /// The corners of each border, in order.
    pub(crate) fn courses(&self) -> impl Iterator<Item = &[Corner]> {
        self.borders.iter().map(|border| &border.corners[..])
    }

    /// The square root of the mean area of a piece: the unit of length for tabs and depths.
    pub fn unit(&self) -> f64 {
        (self.outline_area() / self.pieces() as f64).sqrt()
    }

    /// The area of the outline, in its unit squared.
    pub fn outline_area(&self) -> f64 {
        0.5 * self.doubled_outline as f64 * self.step * self.step
    }

    /// The points of a border.
    pub fn border_points(&self, border: usize) -> Vec<Point> {
        self.borders[border].corners.iter().map(|corner| self.point(*corner)).collect()
    }

    pub(crate) fn point(&self, corner: Corner) -> Point {
        corner.map(|x| x as f64 * self.step)
    }

    /// The corners of a piece, counter-clockwise with y upwards.
    pub(crate) fn corners(&self, piece: usize) -> Vec<Corner> {
        let mut all = Vec::new();
        for (border, is_reversed) in &self.loops[piece] {
            let corners = &self.borders[*border].corners;
            let open = corners.len() - 1;
            if *is_reversed {
                all.extend(corners[1..].iter().rev());
            } else {
                all.extend(&corners[..open]);
            }
        }
        all
    }

    /// The points of a piece, counter-clockwise with y upwards.
    pub fn outline(&self, piece: usize) -> Vec<Point> {
        self.corners(piece).into_iter().map(|corner| self.point(corner)).collect()
    }

    /// Twice the area of a piece in steps squared, exactly.
    pub(crate) fn doubled_area(&self, piece: usize) -> i128 {
        doubled(&self.corners(piece))
    }

    /// The corners of the outline, counter-clockwise with y upwards.
    pub fn outer(&self) -> Vec<Point> {
        let mut around: BTreeMap<Corner, &[Corner]> = BTreeMap::new();
        for border in self.borders.iter().filter(|border| border.right.is_none()) {
            around.insert(border.corners[0], &border.corners);
        }
        let mut found = Vec::new();
        let mut next = around.first_key_value().map(|(corner, _)| *corner);
        while let Some(corners) = next.and_then(|corner| around.remove(&corner)) {
            found.extend(corners[..corners.len() - 1].iter().map(|corner| self.point(*corner)));
            next = corners.last().copied();
        }
        found
    }

    /// The area of a piece, in the unit of the outline squared.
    pub fn area(&self, piece: usize) -> f64 {
        0.5 * self.doubled_area(piece) as f64 * self.step * self.step
    }

    /// The pieces that share a border with a piece, in order.
    pub fn neighbours(&self, piece: usize) -> Vec<usize> {
        let mut found: Vec<usize> = self.loops[piece]
            .iter()
            .filter_map(|(border, is_reversed)| {
                let border = &self.borders[*border];
                if *is_reversed { Some(border.left) } else { border.right }
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The same puzzle with another course of one border between two pieces, rounded to the lattice; its ends stay.
    ///
    /// # Errors
    /// [`PuzzleError::Border`] if the border is part of the outline or does not exist, if the ends differ, or if the course meets
    /// itself or another border.
    pub fn with_border(&self, border: usize, course: &[Point]) -> Result<Self, PuzzleError> {
        let wrong = |why| Err(PuzzleError::Border { border, why });
        let Some(old) = self.borders.get(border).filter(|old| old.right.is_some()) else {
            return wrong("there is no such border between two pieces");
        };
        let mut corners: Vec<Corner> =
            course.iter().map(|p| p.map(|x| (x / self.step).round() as i64)).collect();
        corners.dedup();
        if corners.len() < 2 || corners.first() != old.corners.first() || corners.last() != old.corners.last()
        {
            return wrong("its ends must stay where they are");
        }
        let space = Space::new(self.courses(), self.unit() / self.step);
        if !space.is_free(border, &corners) {
            return wrong("it meets itself or another border");
        }
        let mut changed = self.clone();
        changed.borders[border].corners = corners;
        Ok(changed)
    }

    /// The same puzzle with simplified borders: corners within a distance of the chord are removed, ends stay.
    #[must_use]
    pub fn simplified(&self, distance: f64) -> Self {
        let mut simple = self.clone();
        for border in &mut simple.borders {
            border.corners = simplify(&border.corners, distance / self.step);
        }
        simple
    }
}

/// Twice the area enclosed by corners.
fn doubled(corners: &[Corner]) -> i128 {
    let next = corners.iter().cycle().skip(1);
    let cross = |(a, b): (&Corner, &Corner)| {
        i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0])
    };
    corners.iter().zip(next).map(cross).sum()
}

/// Simplification by Douglas and Peucker (`douglas_algorithms_1973`).
pub(crate) fn simplify(corners: &[Corner], distance: f64) -> Vec<Corner> {
    let points: Vec<Point> = corners.iter().map(|c| c.map(|x| x as f64)).collect();
    corners.iter().zip(kept(&points, distance)).filter_map(|(corner, keep)| keep.then_some(*corner)).collect()
}

/// The same for points.
pub(crate) fn simplify_points(points: &[Point], distance: f64) -> Vec<Point> {
    points.iter().zip(kept(points, distance)).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

fn kept(points: &[Point], distance: f64) -> Vec<bool> {
    let mut keep = vec![false; points.len()];
    let last = points.len().saturating_sub(1);
    if points.is_empty() {
        return keep;
    }
    keep[0] = true;
    keep[last] = true;
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let (a, b) = (points[from], points[to]);
        let u = [b[0] - a[0], b[1] - a[1]];
        let norm_sq = u[0] * u[0] + u[1] * u[1];
        let off = |c: Point| {
            let v = [c[0] - a[0], c[1] - a[1]];
            let t = if norm_sq > 0.0 { ((u[0] * v[0] + u[1] * v[1]) / norm_sq).clamp(0.0, 1.0) } else { 0.0 };
            libm::hypot(v[0] - t * u[0], v[1] - t * u[1])
        };
        let farthest = (from + 1..to).max_by(|i, j| off(points[*i]).total_cmp(&off(points[*j])));
        if let Some(i) = farthest.filter(|i| off(points[*i]) > distance) {
            keep[i] = true;
            open.push((from, i));
            open.push((i, to));
        }
    }
    keep
}
