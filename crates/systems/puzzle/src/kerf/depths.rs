//! How deep points lie in a piece.

use pompeiu_planar::{Outline, Point};
use std::cell::RefCell;

/// Largest number of buckets in a row.
const MOST_BUCKETS: f64 = 256.0;

/// A point so near to the line through two others, relative to the lengths, is not told to be on one side of it.
const NEAR: f64 = 1e-12;

/// The distance of points from the outline of a piece, negative outside, in the part of the plane around a point.
///
/// That part is divided into squares. For each one that is needed, the sides that can be nearest to one of its points are found once, and
/// whether its centre is inside: between the centre and another point of the square no other sides lie.
pub(super) struct Depths {
    sides: Vec<[Point; 2]>,
    low: Point,
    side: f64,
    row: usize,
    /// For each square its bucket, counted from 1; 0 where none was needed yet.
    numbers: RefCell<Vec<u32>>,
    buckets: RefCell<Vec<Bucket>>,
}

struct Bucket {
    centre: Point,
    is_inside: bool,
    sides: Vec<[Point; 2]>,
}

impl Depths {
    /// For points within `reach` of `middle`, many of them within about `side` of each other.
    pub(super) fn new(outline: &Outline, middle: Point, reach: f64, side: f64) -> Self {
        let side = side.max(2.0 * reach / MOST_BUCKETS);
        let row = (2.0 * reach / side) as usize + 1;
        Self {
            sides: outline.sides().collect(),
            low: middle.map(|x| x - reach),
            side,
            row,
            numbers: RefCell::new(vec![0; row * row]),
            buckets: RefCell::new(Vec::new()),
        }
    }

    /// Whether a point lies inside, farther than `depth`, at least 0, from the outline.
    pub(super) fn is_deeper(&self, p: Point, depth: f64) -> bool {
        let is_far = |sides: &[[Point; 2]]| sides.iter().all(|side| distance_sq(p, *side) > depth * depth);
        let [x, y] = [0, 1].map(|k| ((p[k] - self.low[k]) / self.side).floor());
        let end = self.row as f64;
        if !(x >= 0.0 && y >= 0.0 && x < end && y < end) {
            return is_far(&self.sides) && is_inside(&self.sides, p);
        }
        let number = self.bucket([x as usize, y as usize]);
        let buckets = self.buckets.borrow();
        let bucket = &buckets[number];
        is_far(&bucket.sides)
            && match is_crossed_evenly(&bucket.sides, bucket.centre, p) {
                Some(is_even) => bucket.is_inside == is_even,
                None => is_inside(&self.sides, p),
            }
    }

    /// The number of the bucket of a square.
    fn bucket(&self, [x, y]: [usize; 2]) -> usize {
        let mut numbers = self.numbers.borrow_mut();
        let number = &mut numbers[y * self.row + x];
        let mut buckets = self.buckets.borrow_mut();
        if *number == 0 {
            let centre =
                [self.low[0] + (x as f64 + 0.5) * self.side, self.low[1] + (y as f64 + 0.5) * self.side];
            let away: Vec<f64> = self.sides.iter().map(|side| distance_sq(centre, *side).sqrt()).collect();
            let least = away.iter().copied().fold(f64::INFINITY, f64::min);
            // Twice half the diagonal, and far more than rounding.
            let most = (least + std::f64::consts::SQRT_2 * self.side) * (1.0 + 1e-9);
            let near = self.sides.iter().zip(away).filter(|(_, away)| *away <= most);
            buckets.push(Bucket {
                centre,
                is_inside: is_inside(&self.sides, centre),
                sides: near.map(|(side, _)| *side).collect(),
            });
            *number = buckets.len() as u32;
        }
        *number as usize - 1
    }
}

/// Whether the segment between two points crosses sides an even number of times; none where rounding leaves that open.
fn is_crossed_evenly(sides: &[[Point; 2]], p: Point, q: Point) -> Option<bool> {
    let mut is_even = true;
    for [a, b] in sides {
        let ends = [turn(p, q, *a)?, turn(p, q, *b)?];
        if ends[0] != ends[1] && turn(*a, *b, p)? != turn(*a, *b, q)? {
            is_even = !is_even;
        }
    }
    Some(is_even)
}

/// Whether a point lies to the left of the line through two others; none if it lies too near to it.
fn turn(a: Point, b: Point, p: Point) -> Option<bool> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let scale = (u[0].abs() + u[1].abs()) * (v[0].abs() + v[1].abs());
    (cross.abs() > NEAR * scale).then_some(cross > 0.0)
}

/// The even–odd rule.
fn is_inside(sides: &[[Point; 2]], p: Point) -> bool {
    let mut is_inside = false;
    for [a, b] in sides {
        if (a[1] > p[1]) != (b[1] > p[1]) {
            is_inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        }
    }
    is_inside
}

fn distance_sq(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let t = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    let w = [v[0] - t * u[0], v[1] - t * u[1]];
    w[0] * w[0] + w[1] * w[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_planar::distance_to_outline;

    #[test]
    fn depths_are_those_of_all_sides() {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 90.0;
            let radius = 1.0 + 0.4 * libm::sin(9.0 * angle);
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        };
        let outline = Outline::new((0..90).map(at).collect()).unwrap();
        let depths = Depths::new(&outline, [0.2, -0.1], 1.2, 0.07);
        let mut inside = 0;
        for i in 0..60 {
            for j in 0..60 {
                // Corners of the outline, and points on lines through them, are among these.
                let p = if i == 0 { at(j) } else { [0.05 * f64::from(i) - 1.5, 0.05 * j as f64 - 1.5] };
                let away = distance_to_outline(p, &outline);
                for depth in [0.0, 0.03, 0.3] {
                    let expected = outline.contains(p) && away > depth;
                    if (away - depth).abs() > 1e-12 {
                        assert_eq!(depths.is_deeper(p, depth), expected, "{p:?} {depth}");
                        inside += usize::from(expected);
                    }
                }
            }
        }
        assert!(inside > 500, "{inside}");
    }
}
