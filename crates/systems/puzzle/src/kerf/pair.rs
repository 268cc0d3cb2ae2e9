//! Whether two pieces with a gap between them can be separated.

use super::depths::Depths;
use crate::Puzzle;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point};
use rustc_hash::FxHashSet;
use std::collections::BinaryHeap;
use std::ops::Range;

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
const SQUARE: f64 = 0.5;

/// Consecutive points that are tested at once.
const GROUP: usize = 4;

/// Points that are tested first, because they proved earlier cells closed.
const FIRST: usize = 6;

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
    /// Points of each piece that remain after the cut, relative to the middle of the border.
    points: [Vec<Probe>; 2],
    /// Groups of consecutive ones.
    groups: [Vec<Group>; 2],
    middle: Point,
    size: f64,
    width: f64,
}

/// A point of a piece, relative to the middle of the border, and its distance from there.
#[derive(Clone, Copy)]
struct Probe {
    at: Point,
    arm: f64,
}

/// Consecutive points of a piece, within a radius of one.
struct Group {
    middle: Probe,
    radius: f64,
    points: Range<usize>,
}

/// A cell of motions, in the terms that the test of a point needs.
struct Cell {
    shift: Point,
    sine: f64,
    cosine: f64,
    /// The greatest displacement of a point within it by translation, and by rotation per length of its arm.
    translation: f64,
    rotation: f64,
}

impl Cell {
    /// Where a point of one of the pieces lies relative to the other, and the greatest displacement of it within the cell.
    fn moved(&self, piece: usize, Probe { at, arm }: Probe) -> (Point, f64) {
        let (sine, cosine) = (self.sine, self.cosine);
        if piece == 0 {
            let moved = [
                cosine * at[0] - sine * at[1] + self.shift[0],
                sine * at[0] + cosine * at[1] + self.shift[1],
            ];
            // A rotation moves a point by at most its distance from the centre times the angle.
            return (moved, self.translation + self.rotation * arm);
        }
        let at = [at[0] - self.shift[0], at[1] - self.shift[1]];
        let moved = [cosine * at[0] + sine * at[1], cosine * at[1] - sine * at[0]];
        (moved, self.translation + self.rotation * (norm(moved) + self.translation))
    }
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
        let all: Vec<Point> = shared.iter().flatten().copied().collect();
        let n = all.len() as f64;
        let middle = [0, 1].map(|k| all.iter().map(|p| p[k]).sum::<f64>() / n);
        let size = all.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max);
        // A point that has moved is at most this far from the middle of the border.
        let reach = (1.0 + REACH) * size + width;
        let mut pieces = pieces.map(|outline| Depths::new(&outline, middle, reach, SQUARE * width));
        let mut points = [Vec::new(), Vec::new()];
        for (path, border) in shared.iter().zip(borders) {
            let first_is_left = puzzle.borders()[*border].left == pair[0];
            for (on, across) in below(path, spacing) {
                for (piece, sign) in [(usize::from(!first_is_left), 1.0), (usize::from(first_is_left), -1.0)]
                {
                    let depth = sign * 0.5 * (1.0 + ROUNDING) * width;
                    let p = [0, 1].map(|k| on[k] + depth * across[k]);
                    if pieces[piece].is_deeper(p, 0.5 * width) {
                        points[piece].push(Probe::new([0, 1].map(|k| p[k] - middle[k])));
                    }
                }
            }
        }
        let groups = [0, 1].map(|piece| grouped(&points[piece]));
        (size > 0.0).then_some(Self { pieces, points, groups, middle, size, width })
    }

    /// Whether it is proven that no path separates the pieces, with cells of these sizes.
    pub(super) fn holds(&mut self, cells: &[f64], control: &Control) -> bool {
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
    fn search(&mut self, side: f64, extent: f64) -> Search {
        let turn = side / self.size;
        let reach = REACH * self.size;
        let mut seen = FxHashSet::from_iter([[0_i32; 3]]);
        // The farthest cell first, so that a path to the outside is found soon.
        let mut open = BinaryHeap::from([(0, [0_i32; 3])]);
        let mut first = Vec::new();
        while let Some((_, cell)) = open.pop() {
            let [x, y, theta] = cell.map(f64::from);
            let (shift, angle) = ([side * x, side * y], turn * theta);
            if self.is_closed(shift, angle, [extent * side, extent * turn], &mut first) {
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

    /// Whether the pieces overlap at every motion in a cell of some side and turn. Points that prove it are put `first`, for the next cells.
    fn is_closed(
        &mut self,
        shift: Point,
        angle: f64,
        [side, turn]: [f64; 2],
        first: &mut Vec<(usize, usize)>,
    ) -> bool {
        let (sine, cosine) = libm::sincos(angle);
        let translation = side * std::f64::consts::FRAC_1_SQRT_2;
        let cell = Cell { shift, sine, cosine, translation, rotation: 0.5 * turn };
        if let Some(known) = first.iter().position(|(piece, i)| self.is_inside(&cell, *piece, *i)) {
            first[..=known].rotate_right(1);
            return true;
        }
        let found = (0..2).find_map(|piece| Some((piece, self.first_inside(&cell, piece)?)));
        if let Some(found) = found {
            first.truncate(FIRST - 1);
            first.insert(0, found);
        }
        found.is_some()
    }

    /// Whether a point of a piece lies in the other at every motion in a cell.
    fn is_inside(&mut self, cell: &Cell, piece: usize, point: usize) -> bool {
        let (moved, away) = cell.moved(piece, self.points[piece][point]);
        let place = [moved[0] + self.middle[0], moved[1] + self.middle[1]];
        self.pieces[1 - piece].is_deeper(place, self.lost() + away)
    }

    /// The first point of a piece that does.
    fn first_inside(&mut self, cell: &Cell, piece: usize) -> Option<usize> {
        for group in 0..self.groups[piece].len() {
            let Group { middle, radius, points } = &self.groups[piece][group];
            let (radius, points) = (*radius, points.clone());
            let (moved, away) = cell.moved(piece, *middle);
            let place = [moved[0] + self.middle[0], moved[1] + self.middle[1]];
            // The arm of a point of the group is less than that of its middle by the radius at most.
            let least = self.lost() + away - cell.rotation * radius;
            if self.pieces[1 - piece].are_shallower(place, radius, least) {
                continue;
            }
            if let Some(found) = points.into_iter().find(|i| self.is_inside(cell, piece, *i)) {
                return Some(found);
            }
        }
        None
    }

    /// What each piece has lost to the cut.
    fn lost(&self) -> f64 {
        0.5 * (1.0 + ROUNDING) * self.width
    }
}

impl Probe {
    fn new(at: Point) -> Self {
        Self { at, arm: norm(at) }
    }
}

/// Consecutive points in groups.
fn grouped(points: &[Probe]) -> Vec<Group> {
    let starts = (0..points.len()).step_by(GROUP);
    let group = |start: usize| {
        let end = (start + GROUP).min(points.len());
        let of = &points[start..end];
        let middle = Probe::new([0, 1].map(|k| of.iter().map(|p| p.at[k]).sum::<f64>() / of.len() as f64));
        let away = |p: &Probe| distance(p.at, middle.at);
        // A hair more, which rounding may need.
        let radius = of.iter().map(away).fold(0.0, f64::max) * (1.0 + 1e-9);
        Group { middle, radius, points: start..end }
    };
    starts.map(group).collect()
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

fn norm(p: Point) -> f64 {
    (p[0] * p[0] + p[1] * p[1]).sqrt()
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}
