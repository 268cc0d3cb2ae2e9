//! The sides of an outline in a tree of boxes, for many questions about points.

use crate::distance::distance_to_segment;
use crate::outline::{bounds, coord};
use crate::{Outline, Point};

/// Sides in a box that has no boxes in it.
const LEAF: usize = 8;

/// How much farther than the nearest side found a box may be and still be looked into, relative to the greatest coordinate: distances from
/// sides are rounded, and the least of all of them is the answer.
const ROUNDING: f64 = 1e-12;

/// An outline whose consecutive sides are in boxes, and these by twos in larger ones. The answers are those of the outline itself.
pub struct SideTree<'o> {
    points: &'o [Point],
    /// The box of everything is first (at 1); those in box i are at 2 i and 2 i + 1. Boxes beyond the last side are empty.
    boxes: Vec<[Point; 2]>,
    /// Boxes with sides in them, a power of two.
    leaves: usize,
    rounding: f64,
}

impl<'o> SideTree<'o> {
    /// The tree of an outline.
    pub fn new(outline: &'o Outline) -> Self {
        let points = outline.points();
        let n = points.len();
        let leaves = n.div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![bounds(&[]); 2 * leaves];
        for (leaf, around) in boxes[leaves..].iter_mut().enumerate().take(n.div_ceil(LEAF)) {
            let first = leaf * LEAF;
            let [low, high] = bounds(&points[first..n.min(first + LEAF)]);
            let end = points[(first + LEAF).min(n) % n];
            *around = [[0, 1].map(|k| low[k].min(end[k])), [0, 1].map(|k| high[k].max(end[k]))];
        }
        for i in (1..leaves).rev() {
            let [[a, b], [c, d]] = [boxes[2 * i], boxes[2 * i + 1]];
            boxes[i] = [[0, 1].map(|k| a[k].min(c[k])), [0, 1].map(|k| b[k].max(d[k]))];
        }
        let greatest = boxes[1].iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        Self { points, boxes, leaves, rounding: ROUNDING * greatest }
    }

    /// The distance from a point to the curve, as [`crate::distance_to_outline`].
    ///
    /// # Cost
    /// Mostly the logarithm of the number of sides; all of them for the centre of a circle.
    pub fn distance(&self, p: Point) -> f64 {
        self.nearest(p).0
    }

    /// The distance from a point to the curve, and the number of sides that were looked at.
    fn nearest(&self, p: Point) -> (f64, usize) {
        let (mut best, mut looks) = (f64::INFINITY, 0);
        let mut open = vec![(self.away_sq(1, p), 1)];
        while let Some((away_sq, i)) = open.pop() {
            let most = best + self.rounding;
            if away_sq > most * most {
                continue;
            }
            if i >= self.leaves {
                for side in self.sides(i) {
                    best = best.min(distance_to_segment(p, side));
                    looks += 1;
                }
                continue;
            }
            let [one, other] = [2 * i, 2 * i + 1].map(|i| (self.away_sq(i, p), i));
            // The nearer one is looked into first.
            open.extend(if one.0 < other.0 { [other, one] } else { [one, other] });
        }
        (best, looks)
    }

    /// The squared distance of a point from a box; infinite for an empty one.
    fn away_sq(&self, i: usize, p: Point) -> f64 {
        let [low, high] = self.boxes[i];
        let [x, y] = [0, 1].map(|k| (low[k] - p[k]).max(p[k] - high[k]).max(0.0));
        x * x + y * y
    }

    /// The numbers of the corners from which the sides in a box start, which may be none.
    fn run(&self, i: usize) -> [usize; 2] {
        // Boxes of one size are numbered from a power of two on.
        let level = 1 << i.ilog2();
        let width = self.leaves / level * LEAF;
        [0, 1].map(|k| ((i - level + k) * width).min(self.points.len()))
    }

    fn sides(&self, i: usize) -> impl Iterator<Item = [Point; 2]> + '_ {
        let [from, to] = self.run(i);
        let n = self.points.len();
        (from..to).map(move |k| [self.points[k], self.points[(k + 1) % n]])
    }

    /// Whether a point lies inside, as [`Outline::contains`].
    ///
    /// # Cost
    /// The number of boxes that the point lies in, at most that of the sides.
    pub fn contains(&self, p: Point) -> bool {
        let mut is_inside = false;
        let mut open = vec![1];
        while let Some(i) = open.pop() {
            let [low, high] = self.boxes[i];
            // Sides on the left, above or below are not counted.
            if !(low[1] <= p[1] && high[1] > p[1] && high[0] >= p[0]) {
                continue;
            }
            if low[0] > p[0] {
                // Sides on the right count where they pass the height of the point: an odd number does if the ends are on both sides of it.
                let [from, to] = self.run(i).map(|k| self.points[k % self.points.len()][1] > p[1]);
                is_inside ^= from != to;
            } else if i < self.leaves {
                open.extend([2 * i, 2 * i + 1]);
            } else {
                for [a, b] in self.sides(i) {
                    let is_passed = (a[1] > p[1]) != (b[1] > p[1]);
                    is_inside ^=
                        is_passed && (robust::orient2d(coord(a), coord(b), coord(p)) > 0.0) == (b[1] > a[1]);
                }
            }
        }
        is_inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{distance_to_outline, resample};

    /// A comb with thin teeth.
    fn comb(corners: usize) -> Outline {
        let teeth = (0..12).rev().map(|i| 10.0 * f64::from(i));
        let mut points = vec![[0.0, 0.0], [111.0, 0.0]];
        points.extend(teeth.flat_map(|x| [[x + 1.0, 5.0], [x + 1.0, 80.0], [x, 80.0], [x, 5.0]]));
        let outline = Outline::new(points).unwrap();
        if corners == 0 { outline } else { Outline::new(resample(&outline, corners, 0)).unwrap() }
    }

    fn places() -> impl Iterator<Item = Point> {
        // Some of them are on the curve, or as high as corners.
        (0..60).flat_map(|i| (0..60).map(move |j| [3.5 * f64::from(i) - 50.0, 2.5 * f64::from(j) - 30.0]))
    }

    #[test]
    fn answers_are_those_of_the_outline() {
        for corners in [0, 57, 64, 65, 3000] {
            let outline = comb(corners);
            let tree = SideTree::new(&outline);
            for p in places() {
                assert_eq!(tree.distance(p), distance_to_outline(p, &outline), "{p:?}");
                let is_near = tree.distance(p) < 1e-9;
                assert!(is_near || tree.contains(p) == outline.contains(p), "{p:?} of {corners}");
            }
        }
        let triangle = Outline::new(vec![[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]).unwrap();
        let tree = SideTree::new(&triangle);
        assert!(tree.contains([0.5, 0.5]) && !tree.contains([1.5, 1.5]) && !tree.contains([-1.0, 0.5]));
    }

    #[test]
    fn few_sides_are_looked_at() {
        let outline = comb(3000);
        let tree = SideTree::new(&outline);
        let looks: usize = places().map(|p| tree.nearest(p).1).sum();
        let mean = looks as f64 / places().count() as f64;
        assert!(mean < 60.0, "{mean} of 3,000 sides");
    }
}
