//! The sides of a closed curve by their heights, for what meets them and for winding numbers.

use crate::Point;
use crate::outline::{cross, minus};
use crate::predicates::boxes_meet;

/// The sides of a closed curve in strips of equal height.
pub(crate) struct Strips<'c> {
    curve: &'c [Point],
    low: f64,
    height: f64,
    /// For each strip the sides that have a point in it, in order.
    sides: Vec<Vec<usize>>,
}

impl<'c> Strips<'c> {
    pub(crate) fn new(curve: &'c [Point]) -> Self {
        let n = curve.len();
        let heights = curve.iter().map(|p| p[1]);
        let [low, high] =
            heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
        let mut strips = Self { curve, low, height: (high - low) / n as f64, sides: vec![Vec::new(); n] };
        for i in 0..n {
            let (from, to) = strips.span(i);
            for strip in from..=to {
                strips.sides[strip].push(i);
            }
        }
        strips
    }

    /// The strip of an ordinate. A greater one is in no lower strip, however it is rounded.
    fn strip(&self, y: f64) -> usize {
        // Not a number for a curve without height, and 0 as an integer.
        (((y - self.low) / self.height) as usize).min(self.sides.len() - 1)
    }

    /// The first and the last strip of a side.
    fn span(&self, i: usize) -> (usize, usize) {
        let (a, b) = (self.curve[i][1], self.curve[(i + 1) % self.curve.len()][1]);
        (self.strip(a.min(b)), self.strip(a.max(b)))
    }

    /// Pairs of sides whose boxes meet, other than consecutive ones, in order.
    pub(crate) fn near_pairs(&self) -> Vec<[usize; 2]> {
        let n = self.curve.len();
        let side = |i: usize| [self.curve[i], self.curve[(i + 1) % n]];
        let spans: Vec<(usize, usize)> = (0..n).map(|i| self.span(i)).collect();
        let mut found = Vec::new();
        for (strip, sides) in self.sides.iter().enumerate() {
            for (k, &i) in sides.iter().enumerate() {
                for &j in &sides[k + 1..] {
                    // Of the strips of both, a pair counts in the first.
                    if strip != spans[i].0.max(spans[j].0) || j == i + 1 || (i == 0 && j == n - 1) {
                        continue;
                    }
                    if boxes_meet(side(i), side(j)) {
                        found.push([i, j]);
                    }
                }
            }
        }
        found.sort_unstable();
        found
    }

    /// The winding number of the curve around a point.
    pub(crate) fn winding(&self, p: Point) -> i32 {
        let n = self.curve.len();
        let around = |&i: &usize| {
            let (a, b) = (self.curve[i], self.curve[(i + 1) % n]);
            let is_left = || cross(minus(b, a), minus(p, a)) > 0.0;
            if a[1] <= p[1] && b[1] > p[1] && is_left() {
                1
            } else if a[1] > p[1] && b[1] <= p[1] && !is_left() {
                -1
            } else {
                0
            }
        };
        self.sides[self.strip(p[1])].iter().map(around).sum()
    }
}
