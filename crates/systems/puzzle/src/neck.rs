//! Necks: the narrowest places of pieces.

use crate::Puzzle;
use crate::space::Corner;
use pompeiu_planar::{Point, segments_meet};
use std::ops::Range;

/// A part of a piece beyond a neck counts from this share of the mean area of a piece, or from the square of the neck's width, whichever is
/// less: a splinter that hangs by a hair breaks off however small it is.
const PART: f64 = 0.005;

/// Sides of a neck may approach each other by this much, relative to the way along them: corners are rounded to the lattice.
const PARALLEL: f64 = 1e-3;

/// The narrowest place of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Neck {
    /// Its width.
    pub width: f64,
    /// The two points of the outline across which the piece is that narrow.
    pub ends: [Point; 2],
}

impl Puzzle {
    /// The least neck of a piece; `None` if there is none, as in convex pieces.
    ///
    /// # Definition
    /// A neck is a segment within the piece whose length is a local minimum among segments with ends on the outline, and which has
    /// more than half a per cent of the mean area of a piece, or more than the square of its length, on each side. A pointed corner is no
    /// neck, for it is narrower towards its tip everywhere.
    ///
    /// # Cost
    /// The square of the number of corners.
    pub fn neck(&self, piece: usize) -> Option<Neck> {
        let corners = self.corners(piece);
        let all = 0..corners.len();
        let neck = Sides::new(&corners).least(&all, f64::INFINITY, self.least_part())?;
        Some(Neck { width: neck.width * self.step, ends: neck.ends.map(|p| p.map(|x| x * self.step)) })
    }

    /// Whether both pieces have no neck below a width, in steps, on a course that would replace the border between them.
    pub(crate) fn has_room(&self, border: usize, course: &[Corner], width: f64) -> bool {
        let of = &self.borders[border];
        std::iter::once(of.left).chain(of.right).all(|piece| {
            let (corners, changed) = self.corners_with(piece, border, course);
            Sides::new(&corners).least(&changed, width, self.least_part()).is_none()
        })
    }

    /// Twice the area of a part that counts, in steps squared.
    fn least_part(&self) -> f64 {
        PART * self.doubled_outline as f64 / self.pieces() as f64
    }

    /// The corners of a piece with another course of one of its borders, which comes first, and the indices of the corners of that
    /// course.
    fn corners_with(&self, piece: usize, border: usize, course: &[Corner]) -> (Vec<Corner>, Range<usize>) {
        let of = &self.loops[piece];
        let first = of.iter().position(|(other, _)| *other == border).unwrap_or(0);
        let mut all = Vec::new();
        for (other, is_reversed) in of[first..].iter().chain(&of[..first]) {
            let corners = if *other == border { course } else { &self.borders[*other].corners };
            let open = corners.len() - 1;
            if *is_reversed {
                all.extend(corners[1..].iter().rev());
            } else {
                all.extend(&corners[..open]);
            }
        }
        (all, 0..course.len())
    }
}

/// A closed curve, counter-clockwise, with what is asked of it many times.
struct Sides {
    /// Corners relative to the first one.
    points: Vec<Point>,
    first: Corner,
    /// Twice the area between the origin and the curve up to each point.
    areas: Vec<f64>,
    /// Whether the curve turns to the right there.
    is_reflex: Vec<bool>,
}

/// A point of the curve: a corner, or a point of the side after it.
#[derive(Clone, Copy)]
struct Foot {
    side: usize,
    at: Point,
    is_corner: bool,
}

impl Sides {
    fn new(corners: &[Corner]) -> Self {
        // Differences on the lattice and their products are exact.
        let points: Vec<Point> =
            corners.iter().map(|c| [0, 1].map(|k| (c[k] - corners[0][k]) as f64)).collect();
        let n = points.len();
        let mut areas = vec![0.0];
        areas.extend((0..n).scan(0.0, |sum, i| {
            *sum += cross(points[i], points[(i + 1) % n]);
            Some(*sum)
        }));
        let turn = |i: usize| {
            let [before, here, after] = [points[(i + n - 1) % n], points[i], points[(i + 1) % n]];
            cross(minus(here, before), minus(after, here))
        };
        let is_reflex = (0..n).map(|i| turn(i) < 0.0).collect();
        Self { points, first: corners[0], areas, is_reflex }
    }

    /// The least neck below a width that has an end at one of some corners or on a side between them.
    fn least(&self, changed: &Range<usize>, below: f64, least_part: f64) -> Option<Neck> {
        let n = self.points.len();
        let (mut found, mut width) = (None, below);
        for corner in (0..n).filter(|i| self.is_reflex[*i]) {
            let p = Foot { side: corner, at: self.points[corner], is_corner: true };
            let is_changed = changed.contains(&corner);
            for side in 0..n {
                let ends = [side, (side + 1) % n];
                let is_new = is_changed || ends.iter().all(|end| changed.contains(end));
                if !is_new || ends.contains(&corner) || self.is_beyond(side, p.at, width) {
                    continue;
                }
                let q = self.nearest(side, p.at);
                if !self.is_locally_least(p, q) {
                    continue;
                }
                let length = norm(minus(q.at, p.at));
                let is_neck = length < width
                    && self.least_side(p, q) > least_part.min(2.0 * length * length)
                    && self.is_within(p, q);
                if is_neck {
                    width = length;
                    let place = |foot: Foot| [0, 1].map(|k| foot.at[k] + self.first[k] as f64);
                    found = Some(Neck { width, ends: [place(p), place(q)] });
                }
            }
        }
        found
    }

    /// Whether the box around a side alone shows that a point is not nearer to it than a width.
    fn is_beyond(&self, side: usize, p: Point, width: f64) -> bool {
        let (a, b) = (self.points[side], self.points[(side + 1) % self.points.len()]);
        (0..2).any(|k| p[k] - a[k].max(b[k]) > width || a[k].min(b[k]) - p[k] > width)
    }

    /// The point of a side nearest to a point.
    fn nearest(&self, side: usize, p: Point) -> Foot {
        let n = self.points.len();
        let next = (side + 1) % n;
        let (a, b) = (self.points[side], self.points[next]);
        let (u, v) = (minus(b, a), minus(p, a));
        let t = dot(u, v) / dot(u, u);
        if t <= 0.0 {
            Foot { side, at: a, is_corner: true }
        } else if t >= 1.0 {
            Foot { side: next, at: b, is_corner: true }
        } else {
            Foot { side, at: [0, 1].map(|k| a[k] + t * u[k]), is_corner: false }
        }
    }

    /// Whether the segment from a corner to another point lies inside at its ends and is nowhere longer than its neighbours.
    fn is_locally_least(&self, p: Foot, q: Foot) -> bool {
        if !self.does_not_approach(p.side, q.at) {
            return false;
        }
        if q.is_corner {
            return self.is_reflex[q.side] && self.does_not_approach(q.side, p.at);
        }
        let next = (q.side + 1) % self.points.len();
        cross(minus(self.points[next], self.points[q.side]), minus(p.at, q.at)) > 0.0
    }

    /// Whether the curve leads away from a point on both sides of a reflex corner. Then the segment between both begins inside: the
    /// outside of the corner is within a right angle of one of its sides.
    fn does_not_approach(&self, corner: usize, q: Point) -> bool {
        let n = self.points.len();
        let here = self.points[corner];
        let away = minus(here, q);
        [(corner + n - 1) % n, (corner + 1) % n].into_iter().all(|other| {
            let along = minus(self.points[other], here);
            let ahead = dot(along, away);
            ahead >= 0.0 || ahead * ahead <= PARALLEL * PARALLEL * dot(along, along) * dot(away, away)
        })
    }

    /// Twice the area on the smaller side of a segment.
    fn least_side(&self, p: Foot, q: Foot) -> f64 {
        let n = self.points.len();
        let until = |foot: Foot| self.areas[foot.side] + cross(self.points[foot.side], foot.at);
        let all = self.areas[n];
        let (from, to) = (until(p), until(q));
        let one = (to - from + cross(q.at, p.at)).rem_euclid(all);
        one.min(all - one)
    }

    /// Whether a segment meets no side but those at its ends.
    fn is_within(&self, p: Foot, q: Foot) -> bool {
        let n = self.points.len();
        (0..n).all(|side| {
            let is_at = |foot: Foot| side == foot.side || (foot.is_corner && (side + 1) % n == foot.side);
            is_at(p)
                || is_at(q)
                || !segments_meet([p.at, q.at], [self.points[side], self.points[(side + 1) % n]])
        })
    }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn norm(a: Point) -> f64 {
    libm::hypot(a[0], a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn least(corners: &[Corner]) -> Option<Neck> {
        let sides = Sides::new(corners);
        // Parts of a hundredth count.
        let least_part = 0.01 * sides.areas[corners.len()];
        sides.least(&(0..corners.len()), f64::INFINITY, least_part)
    }

    #[test]
    fn the_neck_of_a_dumbbell_is_its_bar() {
        let bar = [
            [0, 0],
            [100, 0],
            [100, 40],
            [200, 45],
            [200, 0],
            [300, 0],
            [300, 100],
            [200, 100],
            [200, 55],
            [100, 60],
            [100, 100],
            [0, 100],
        ];
        let neck = least(&bar).unwrap();
        assert!((neck.width - 10.0).abs() < 1e-12, "{neck:?}");
        assert!(neck.ends.iter().all(|end| end[0] == 200.0), "{neck:?}");
        let moved = bar.map(|[x, y]| [1_000_000 - y, 2_000_000 + x]);
        let neck = least(&moved).unwrap();
        assert_eq!((neck.width, neck.ends[0][1]), (10.0, 2_000_200.0));
    }

    #[test]
    fn corners_and_convex_pieces_have_no_neck() {
        assert_eq!(least(&[[0, 0], [100, 0], [0, 10]]), None, "a pointed corner");
        assert_eq!(least(&[[0, 0], [1000, 0], [1000, 10], [0, 10]]), None, "a strip");
        assert_eq!(least(&[[0, 0], [100, 0], [50, 10], [50, 100]]), None, "a hook that widens");
    }

    #[test]
    fn a_notch_near_a_side_makes_a_neck_unless_little_is_beyond_it() {
        // The tip of the notch is 4 from the right side.
        let notch = |y: i64| [[0, 0], [100, 0], [100, 100], [0, 100], [0, y + 10], [96, y], [0, y - 10]];
        let neck = least(&notch(50)).unwrap();
        assert_eq!((neck.width, neck.ends), (4.0, [[96.0, 50.0], [100.0, 50.0]]));
        // Below a slit of length 12 there is far less than a hundredth: a block that is shorter than it is high, or a splinter.
        let slit = |y: i64| [[0, 0], [1000, 0], [1000, 1000], [0, 1000], [0, y + 5], [12, y], [0, y]];
        let width = |y: i64| least(&slit(y)).map(|neck| neck.width);
        assert_eq!(
            width(20),
            Some(988.0),
            "less than the square of the width is below; right of it there is much"
        );
        assert_eq!(width(4), Some(4.0), "a splinter");
    }

    #[test]
    fn what_is_outside_between_two_sides_is_no_neck() {
        // A horseshoe: its ends are 2 apart, but outside.
        let shoe = [
            [0, 0],
            [100, 0],
            [100, 100],
            [51, 100],
            [51, 80],
            [80, 80],
            [80, 20],
            [20, 20],
            [20, 80],
            [49, 80],
            [49, 100],
            [0, 100],
        ];
        assert_eq!(least(&shoe).map(|neck| neck.width), Some(20.0));
    }
}
