//! Whether two pieces with a gap between them can be separated.

use crate::Puzzle;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, distance_to_outline};
use std::cell::RefCell;
use std::collections::{BTreeSet, BinaryHeap};

/// Cell sizes relative to the width of the cut; the next one is tried if a path to the outside exists at the previous one.
pub(super) const CELLS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// Largest number of cells visited.
const MOST: usize = 60_000;

/// Distance at which a piece counts as separated, relative to the size of the common border; and the largest rotation considered.
const REACH: f64 = 0.5;
const MOST_TURN: f64 = 0.7;

/// Largest number of sample points on each side of the common border.
const POINTS: usize = 160;

/// Distance of the nodes at which depths are kept, relative to the width of the cut, and the largest number of nodes in a row.
const NODES: f64 = 0.0625;
const MOST_NODES: f64 = 1500.0;

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
        let pieces = pieces.map(|outline| Depths::new(outline, middle, reach, width));
        (size > 0.0).then_some(Self { pieces, points, middle, size, width })
    }

    /// Whether it is proven that no path separates the pieces, with cells of these sizes.
    pub(super) fn holds(&self, cells: &[f64], control: &Control) -> bool {
        for cell in cells {
            if control.is_stopped() {
                return false;
            }
            match self.search(cell * self.width) {
                Search::Enclosed => return true,
                // Smaller cells are even more.
                Search::TooMany => return false,
                Search::Outside => (),
            }
        }
        false
    }

    fn search(&self, side: f64) -> Search {
        let turn = side / self.size;
        let reach = REACH * self.size;
        let mut seen = BTreeSet::from([[0_i32; 3]]);
        // The farthest cell first, so that a path to the outside is found soon.
        let mut open = BinaryHeap::from([(0, [0_i32; 3])]);
        let mut last = [0, 0];
        while let Some((_, cell)) = open.pop() {
            let [x, y, theta] = cell.map(f64::from);
            let (shift, angle) = ([side * x, side * y], turn * theta);
            if self.is_closed(shift, angle, side, turn, &mut last) {
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

    /// Whether the pieces overlap at every motion in a cell. `last` caches the points that proved it for the previous cell.
    fn is_closed(&self, shift: Point, angle: f64, side: f64, turn: f64, last: &mut [usize; 2]) -> bool {
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

/// How deep points lie in a piece: the distance from its outline, negative outside. It changes no faster than points move, so depths
/// at the nodes of a grid, computed when they are first needed, decide most questions.
struct Depths {
    outline: Outline,
    low: Point,
    spacing: f64,
    row: usize,
    /// NaN where it was not needed yet.
    nodes: RefCell<Vec<f64>>,
}

impl Depths {
    fn new(outline: Outline, middle: Point, reach: f64, width: f64) -> Self {
        let spacing = (NODES * width).max(2.0 * reach / MOST_NODES);
        let row = (2.0 * reach / spacing) as usize + 2;
        let low = middle.map(|x| x - reach);
        Self { outline, low, spacing, row, nodes: RefCell::new(vec![f64::NAN; row * row]) }
    }

    /// Whether a point lies inside, farther than `depth` from the curve.
    fn is_deeper(&self, p: Point, depth: f64) -> bool {
        let [x, y] = [0, 1].map(|k| ((p[k] - self.low[k]) / self.spacing).round());
        let last = (self.row - 1) as f64;
        if !(x >= 0.0 && y >= 0.0 && x <= last && y <= last) {
            return self.depth(p) > depth;
        }
        let node = [self.low[0] + x * self.spacing, self.low[1] + y * self.spacing];
        let index = y as usize * self.row + x as usize;
        let mut nodes = self.nodes.borrow_mut();
        if nodes[index].is_nan() {
            nodes[index] = self.depth(node);
        }
        let w = [p[0] - node[0], p[1] - node[1]];
        // Far more than rounding.
        let away = (w[0] * w[0] + w[1] * w[1]).sqrt() + ROUNDING * self.spacing;
        if nodes[index] - away > depth {
            true
        } else if nodes[index] + away < depth {
            false
        } else {
            self.depth(p) > depth
        }
    }

    fn depth(&self, p: Point) -> f64 {
        let (mut is_inside, mut least_sq) = (false, f64::INFINITY);
        let points = self.outline.points();
        let mut a = points[points.len() - 1];
        for &b in points {
            if (a[1] > p[1]) != (b[1] > p[1]) {
                let at = a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                is_inside ^= p[0] < at;
            }
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let t = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
            let w = [v[0] - t * u[0], v[1] - t * u[1]];
            least_sq = least_sq.min(w[0] * w[0] + w[1] * w[1]);
            a = b;
        }
        if is_inside { least_sq.sqrt() } else { -least_sq.sqrt() }
    }
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}
