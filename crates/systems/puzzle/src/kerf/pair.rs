//! Whether two pieces with a gap between them can be separated.

use super::depths::Depths;
use crate::Puzzle;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, distance_to_outline};
use std::collections::{BinaryHeap, HashSet};

/// Cell sizes relative to the width of the cut; the next one is tried if a path to the outside exists at the previous one.
pub(super) const CELLS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// The steps of motions that are tried before smaller cells are, relative to the width of the cut.
const STEP: f64 = 0.5;

/// Largest number of cells visited.
const MOST: usize = 60_000;

/// Distance at which a piece counts as separated, relative to the size of the common border; and the largest rotation considered.
const REACH: f64 = 0.5;
const MOST_TURN: f64 = 0.7;

/// Largest number of sample points on each side of the common border.
const POINTS: usize = 160;

/// The side of the squares in which depths are looked up, relative to the width of the cut.
const SQUARE: f64 = 2.0;

/// Safety margin for rounding, relative to the width of the cut.
const ROUNDING: f64 = 1e-6;

/// Two pieces with a gap between them.
///
/// A motion of the first piece rotates it by θ about the middle of the common border and translates it by t. The space of (t, θ) is
/// divided into cells. A cell is closed if, at its centre, some point of one piece lies so deep in the other that no motion in the
/// cell frees it: deeper than half the cut, which the other piece has lost, plus the greatest displacement of a point within the
/// cell. The test points lie half the cut inside their own piece. Starting from the assembled position, all cells that are not
/// closed are visited; if none of them is far away, no path of motions separates the pieces.
pub(super) struct Pair {
    pieces: [Depths; 2],
    /// Points of each piece that remain after the cut.
    points: [Vec<Point>; 2],
    middle: Point,
    size: f64,
    width: f64,
}

/// How a search among cells of one size ends.
enum Search {
    /// No cell that is reached is outside.
    Enclosed,
    /// A cell outside is reached.
    Outside,
    /// More cells are reached than are visited.
    TooMany,
}

impl Pair {
    /// `None` if the cut removes all of the common border.
    pub(super) fn new(puzzle: &Puzzle, pair: [usize; 2], borders: &[usize], width: f64) -> Option<Self> {
        let pieces =
            [Outline::new(puzzle.outline(pair[0])).ok()?, Outline::new(puzzle.outline(pair[1])).ok()?];
        let shared: Vec<Vec<Point>> = borders.iter().map(|border| puzzle.border_points(*border)).collect();
        let length: f64 = shared.iter().flat_map(|path| path.windows(2)).map(|p| distance(p[0], p[1])).sum();
        let spacing = (0.5 * width).max(length / POINTS as f64);
        let mut points = [Vec::new(), Vec::new()];
        let mut all: Vec<Point> = Vec::new();
        for (path, border) in shared.iter().zip(borders) {
            let first_is_left = puzzle.borders()[*border].left == pair[0];
            all.extend(path);
            for (on, across) in below(path, spacing) {
                for (piece, sign) in [(usize::from(!first_is_left), 1.0), (usize::from(first_is_left), -1.0)]
                {
                    let depth = sign * 0.5 * (1.0 + ROUNDING) * width;
                    let p = [0, 1].map(|k| on[k] + depth * across[k]);
                    let own = &pieces[piece];
                    if own.contains(p) && distance_to_outline(p, own) >= 0.5 * width {
                        points[piece].push(p);
                    }
                }
            }
        }
        let n = all.len() as f64;
        let middle = [0, 1].map(|k| all.iter().map(|p| p[k]).sum::<f64>() / n);
        let size = all.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max);
        // A point that has moved is at most this far from the middle of the border.
        let reach = (1.0 + REACH) * size + width;
        let pieces = pieces.map(|outline| Depths::new(&outline, middle, reach, SQUARE * width));
        (size > 0.0).then_some(Self { pieces, points, middle, size, width })
    }

    /// Whether it is proven that no path separates the pieces, with cells of these sizes.
    pub(super) fn holds(&self, cells: &[f64], control: &Control) -> bool {
        for (i, cell) in cells.iter().enumerate() {
            if control.is_stopped() {
                return false;
            }
            match self.search(cell * self.width, 1.0) {
                Search::Enclosed => return true,
                // Smaller cells are even more.
                Search::TooMany => return false,
                // Smaller cells help unless there is a way out, step by step.
                Search::Outside if i == 0 => match self.search(STEP * self.width, 0.0) {
                    Search::Enclosed => (),
                    Search::Outside | Search::TooMany => return false,
                },
                Search::Outside => (),
            }
        }
        false
    }

    /// A search among cells of a size. With `extent` 1 a cell is closed if all motions in it are; with 0 if that in its centre is.
    fn search(&self, side: f64, extent: f64) -> Search {
        let turn = side / self.size;
        let reach = REACH * self.size;
        let mut seen = HashSet::from([[0_i32; 3]]);
        // The farthest cell first, so that a path to the outside is found soon.
        let mut open = BinaryHeap::from([(0, [0_i32; 3])]);
        let mut last = [0, 0];
        while let Some((_, cell)) = open.pop() {
            let [x, y, theta] = cell.map(f64::from);
            let (shift, angle) = ([side * x, side * y], turn * theta);
            if self.is_closed(shift, angle, [extent * side, extent * turn], &mut last) {
                continue;
            }
            if libm::hypot(shift[0], shift[1]) > reach || angle.abs() > MOST_TURN {
                return Search::Outside;
            }
            if seen.len() > MOST {
                return Search::TooMany;
            }
            for k in 0..3 {
                for way in [-1, 1] {
                    let mut next = cell;
                    next[k] += way;
                    if seen.insert(next) {
                        open.push((next.map(|i| i * i).iter().sum::<i32>(), next));
                    }
                }
            }
        }
        Search::Enclosed
    }

    /// Whether the pieces overlap at every motion in a cell of some side and turn. `last` caches the points that proved it for the previous cell.
    fn is_closed(&self, shift: Point, angle: f64, [side, turn]: [f64; 2], last: &mut [usize; 2]) -> bool {
        let (sine, cosine) = libm::sincos(angle);
        let own = 0.5 * (1.0 + ROUNDING) * self.width;
        let translation = side * std::f64::consts::FRAC_1_SQRT_2;
        for piece in 0..2 {
            let other = &self.pieces[1 - piece];
            let n = self.points[piece].len();
            for i in 0..n {
                let i = (last[piece] + i) % n;
                let p = self.points[piece][i];
                let q = [0, 1].map(|k| p[k] - self.middle[k]);
                let moved = if piece == 0 {
                    [cosine * q[0] - sine * q[1] + shift[0], sine * q[0] + cosine * q[1] + shift[1]]
                } else {
                    let q = [q[0] - shift[0], q[1] - shift[1]];
                    [cosine * q[0] + sine * q[1], cosine * q[1] - sine * q[0]]
                };
                // A rotation moves a point by at most its distance from the centre times the angle.
                let arm = if piece == 0 {
                    libm::hypot(q[0], q[1])
                } else {
                    libm::hypot(moved[0], moved[1]) + translation
                };
                let needed = own + translation + 0.5 * turn * arm;
                let place = [0, 1].map(|k| moved[k] + self.middle[k]);
                if other.is_deeper(place, needed) {
                    last[piece] = i;
                    return true;
                }
            }
        }
        false
    }
}

/// Points along a path, its corners included, each with the offset vector to its left that has distance 1 from both adjacent sides.
fn below(path: &[Point], spacing: f64) -> Vec<(Point, Point)> {
    let left = |a: Point, b: Point| {
        let side = distance(a, b);
        [(a[1] - b[1]) / side, (b[0] - a[0]) / side]
    };
    let mut found = Vec::new();
    for (i, ends) in path.windows(2).enumerate() {
        let (a, b, normal) = (ends[0], ends[1], left(ends[0], ends[1]));
        if i > 0 {
            let before = left(path[i - 1], a);
            let scale = 1.0 + before[0] * normal[0] + before[1] * normal[1];
            // Where the path reverses, there is no such vector.
            if scale > 1e-3 {
                found.push((a, [0, 1].map(|k| (before[k] + normal[k]) / scale)));
            }
        }
        let count = (distance(a, b) / spacing).ceil().max(1.0) as usize;
        found.extend((0..count).map(|i| {
            let s = (i as f64 + 0.5) / count as f64;
            ([0, 1].map(|k| a[k] + s * (b[k] - a[k])), normal)
        }));
    }
    found
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}
