//! Triangulating a simple polygon in O(n log n): cut into monotone parts by a sweep, each part triangulated in one pass.
//!
//! The signs of areas are exact (`robust::orient2d`), so the result is correct for every polygon that neither crosses nor touches
//! itself. For others it is arbitrary, and the caller has to check it.
//!
//! # Source
//! `deberg_geometry_2008`, sections 3.2 and 3.3. Our version finds the parts by traversing them, with the diagonals at a corner
//! sorted by angle. It keeps the edges that cross the sweep line in an ordered set: two edges that do not cross have the same order
//! at every height.

use robust::{Coord, orient2d};
use std::cmp::Ordering;
use std::collections::BTreeSet;

type Point = [f64; 2];

/// Positive when a, b, c turn counterclockwise.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

/// The order of the sweep: from top to bottom, and from left to right at equal height.
fn sweep_order(a: Point, b: Point) -> Ordering {
    f64::total_cmp(&b[1], &a[1]).then(f64::total_cmp(&a[0], &b[0]))
}

/// An edge that crosses the sweep line, or a point if both ends are equal; ordered from left to right.
#[derive(Clone, Copy)]
struct Crossed {
    upper: Point,
    lower: Point,
    edge: u32,
}

impl Crossed {
    /// On which side of the edge a point is: `Less` is to its left.
    fn side(&self, point: Point) -> Ordering {
        // The edge is directed downwards, so its left-hand side is on the right in the plane.
        f64::total_cmp(&turn(self.upper, self.lower, point), &0.0)
    }
}

impl Ord for Crossed {
    fn cmp(&self, other: &Self) -> Ordering {
        if self.edge == other.edge {
            return Ordering::Equal;
        }
        // Compares at the start of the edge that begins later, and at the end of the shorter one if that does not decide.
        if sweep_order(self.upper, other.upper).is_le() {
            let end = if sweep_order(self.lower, other.lower).is_ge() {
                self.side(other.lower)
            } else {
                other.side(self.lower).reverse()
            };
            self.side(other.upper).then(end).reverse().then(self.edge.cmp(&other.edge))
        } else {
            other.cmp(self).reverse()
        }
    }
}

impl PartialOrd for Crossed {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Crossed {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Crossed {}

/// Appends the triangles of a polygon as indices of its corners, which must be counterclockwise; n − 2 triangles if the polygon is
/// simple.
pub(super) fn triangulate(plane: &[Point], triangles: &mut Vec<u32>) {
    let mut diagonals = Sweep::new(plane).diagonals();
    let n = plane.len() as u32;
    // Both directions, ordered by the corner they start at.
    diagonals.extend_from_within(..);
    let half = diagonals.len() / 2;
    for diagonal in &mut diagonals[half..] {
        diagonal.swap(0, 1);
    }
    diagonals.sort_unstable_by(|a, b| a[0].cmp(&b[0]).then_with(|| by_angle(plane, a[0], a[1], b[1])));
    diagonals.dedup();
    let of_corner = |corner: u32| {
        let start = diagonals.partition_point(|diagonal| diagonal[0] < corner);
        let length = diagonals[start..].partition_point(|diagonal| diagonal[0] == corner);
        start..start + length
    };
    // Every part has a side that begins with a diagonal, unless there are no diagonals and the only part is the polygon.
    let mut walked = vec![false; diagonals.len()];
    let mut part = Vec::new();
    if diagonals.is_empty() {
        part.extend(0..n);
        triangulate_part(plane, &part, triangles);
    }
    for first in 0..diagonals.len() {
        if walked[first] {
            continue;
        }
        part.clear();
        let mut next = Some(first);
        let mut at = diagonals[first][0];
        // Every side is followed by exactly one other, even around corners in a wrong order, so the traversal returns to its start.
        loop {
            part.push(at);
            let from = at;
            at = match next {
                Some(diagonal) => {
                    walked[diagonal] = true;
                    diagonals[diagonal][1]
                }
                None => (at + 1) % n,
            };
            // The last one before the side that led to the corner, counterclockwise from the polygon's next side.
            let around = of_corner(at);
            let before = if (from + 1) % n == at && next.is_none() {
                around.end
            } else {
                around.start
                    + diagonals[around.clone()].iter().take_while(|diagonal| diagonal[1] != from).count()
            };
            next = (before > around.start).then(|| before - 1);
            if next == Some(first) {
                break;
            }
        }
        triangulate_part(plane, &part, triangles);
    }
}

/// The order of two corners around `corner`, counterclockwise from the side of the polygon that begins there.
fn by_angle(plane: &[Point], corner: u32, a: u32, b: u32) -> Ordering {
    let center = plane[corner as usize];
    let side = plane[(corner as usize + 1) % plane.len()];
    let is_beyond = |point: Point| turn(center, side, point) < 0.0;
    let (a, b) = (plane[a as usize], plane[b as usize]);
    is_beyond(a).cmp(&is_beyond(b)).then_with(|| f64::total_cmp(&0.0, &turn(center, a, b)))
}

/// The state of the sweep that finds diagonals which divide the polygon into monotone parts.
struct Sweep<'a> {
    plane: &'a [Point],
    crossed: BTreeSet<Crossed>,
    /// For each edge, the last corner seen between it and the next edge to the right.
    helpers: Vec<u32>,
    diagonals: Vec<[u32; 2]>,
}

impl<'a> Sweep<'a> {
    fn new(plane: &'a [Point]) -> Self {
        Self { plane, crossed: BTreeSet::new(), helpers: vec![0; plane.len()], diagonals: Vec::new() }
    }

    fn previous(&self, corner: u32) -> u32 {
        corner.checked_sub(1).unwrap_or(self.plane.len() as u32 - 1)
    }

    fn next(&self, corner: u32) -> u32 {
        (corner + 1) % self.plane.len() as u32
    }

    fn point(&self, corner: u32) -> Point {
        self.plane[corner as usize]
    }

    fn is_before(&self, a: u32, b: u32) -> bool {
        sweep_order(self.point(a), self.point(b)).then(a.cmp(&b)).is_lt()
    }

    /// Whether the corner is a merge vertex: the inside changes there from below two sides to between them.
    fn merges(&self, corner: u32) -> bool {
        let (previous, next) = (self.previous(corner), self.next(corner));
        self.is_before(previous, corner) && self.is_before(next, corner) && self.is_reflex(corner)
    }

    fn is_reflex(&self, corner: u32) -> bool {
        let [a, b, c] = [self.previous(corner), corner, self.next(corner)].map(|corner| self.point(corner));
        turn(a, b, c) < 0.0
    }

    fn diagonals(mut self) -> Vec<[u32; 2]> {
        let mut order: Vec<u32> = (0..self.plane.len() as u32).collect();
        order.sort_unstable_by(|&a, &b| sweep_order(self.point(a), self.point(b)).then(a.cmp(&b)));
        for corner in order {
            let previous = self.previous(corner);
            match (self.is_before(previous, corner), self.is_before(self.next(corner), corner)) {
                // The inside begins here, or is split in two.
                (false, false) => {
                    if self.is_reflex(corner) {
                        self.connect_left(corner, true);
                    }
                    self.begin(corner);
                }
                // The inside is to the right.
                (true, false) => {
                    self.finish(previous, corner);
                    self.begin(corner);
                }
                // The inside is to the left.
                (false, true) => self.connect_left(corner, false),
                // The inside ends here, or two parts of it merge.
                (true, true) => {
                    self.finish(previous, corner);
                    if self.is_reflex(corner) {
                        self.connect_left(corner, false);
                    }
                }
            }
        }
        self.diagonals
    }

    fn edge(&self, edge: u32) -> Crossed {
        Crossed { upper: self.point(edge), lower: self.point(self.next(edge)), edge }
    }

    /// The side after a corner now crosses the sweep line, with the inside to its right.
    fn begin(&mut self, corner: u32) {
        self.crossed.insert(self.edge(corner));
        self.helpers[corner as usize] = corner;
    }

    /// A side ends at a corner.
    fn finish(&mut self, edge: u32, corner: u32) {
        if self.merges(self.helpers[edge as usize]) {
            self.diagonals.push([corner, self.helpers[edge as usize]]);
        }
        self.crossed.remove(&self.edge(edge));
    }

    /// Makes the corner the helper of the edge to its left; connects it with the previous helper if that is a merge vertex, or
    /// always.
    fn connect_left(&mut self, corner: u32, always: bool) {
        let point = self.point(corner);
        let probe = Crossed { upper: point, lower: point, edge: u32::MAX };
        if let Some(left) = self.crossed.range(..probe).next_back() {
            let helper = &mut self.helpers[left.edge as usize];
            let last = std::mem::replace(helper, corner);
            if always || self.merges(last) {
                self.diagonals.push([corner, last]);
            }
        }
    }
}

/// Triangulates a part whose left and right sides are monotone.
fn triangulate_part(plane: &[Point], part: &[u32], triangles: &mut Vec<u32>) {
    let count = part.len();
    let point = |place: usize| plane[part[place] as usize];
    let order = |a: usize, b: usize| sweep_order(point(a), point(b)).then(part[a].cmp(&part[b]));
    let Some(top) = (0..count).min_by(|&a, &b| order(a, b)) else { return };
    // Counterclockwise from the top, corners on the left go down and corners on the right go up.
    let (mut left, mut right) = (1, count);
    let at = |step: usize| (top + step) % count;
    let mut merged = vec![(top, true)];
    while left < right {
        if order(at(left), at(right - 1)).is_le() {
            merged.push((at(left), true));
            left += 1;
        } else {
            right -= 1;
            merged.push((at(right), false));
        }
    }
    let mut emit = |a: usize, b: usize, c: usize, on_left: bool| {
        let [b, c] = if on_left { [b, c] } else { [c, b] };
        triangles.extend([part[a], part[b], part[c]]);
    };
    let mut open: Vec<(usize, bool)> = Vec::new();
    for (step, &(corner, is_left)) in merged.iter().enumerate() {
        let is_last = step + 1 == merged.len();
        if let Some(&top_of_open) = open.last().filter(|last| is_last || last.1 != is_left) {
            // All open corners are on the other side and visible from here.
            for pair in open.windows(2) {
                emit(corner, pair[0].0, pair[1].0, top_of_open.1);
            }
            open.clear();
            open.push(top_of_open);
        } else {
            while let [.., (a, _), (b, _)] = open[..] {
                let area = turn(point(a), point(b), point(corner));
                if if is_left { area <= 0.0 } else { area >= 0.0 } {
                    break;
                }
                emit(a, b, corner, is_left);
                open.pop();
            }
        }
        open.push((corner, is_left));
    }
}
