//! Whether a closed polygon crosses itself.

use crate::distance::distance_to_segment;
use crate::outline::{cross as cross_product, minus};
use crate::{Outline, Point, Turn, orientation, segments_meet};

/// Two sides with a common point other than the corner that neighbours share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The sides, each named by the corner that it starts from; the first one is less.
    pub sides: [usize; 2],
    /// Approximate place of a point of both.
    pub place: Point,
}

/// The first pair of sides of a closed polygon that cross or touch, or none where the polygon is simple. Decided exactly.
///
/// # Cost
/// Sides are sorted by their least abscissa and compared while their boxes overlap: n log n for outlines without long sides, n² at
/// worst.
pub fn first_crossing(outline: &Outline) -> Option<Crossing> {
    first_crossing_of(outline.points())
}

/// As [`first_crossing`], of a closed polygon that may have no area.
pub(crate) fn first_crossing_of(points: &[Point]) -> Option<Crossing> {
    let n = points.len();
    let side = |i: usize| [points[i], points[(i + 1) % n]];
    let spans: Vec<[f64; 4]> = (0..n)
        .map(|i| {
            let [a, b] = side(i);
            [a[0].min(b[0]), a[0].max(b[0]), a[1].min(b[1]), a[1].max(b[1])]
        })
        .collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| spans[*i][0].total_cmp(&spans[*j][0]).then(i.cmp(j)));
    let mut active: Vec<usize> = Vec::new();
    let mut found: Option<[usize; 2]> = None;
    for &i in &order {
        active.retain(|&j| spans[j][1] >= spans[i][0]);
        for &j in &active {
            let pair = [i.min(j), i.max(j)];
            let apart = spans[j][2] > spans[i][3] || spans[i][2] > spans[j][3];
            if !apart && found.is_none_or(|found| pair < found) && cross(pair, n, side) {
                found = Some(pair);
            }
        }
        active.push(i);
    }
    found.map(|sides| Crossing { sides, place: meeting(sides.map(side)) })
}

/// A point that two segments which meet have in common, but for rounding.
fn meeting([[a, b], [c, d]]: [[Point; 2]; 2]) -> Point {
    let (u, v) = (minus(b, a), minus(d, c));
    let along = cross_product(minus(c, a), v) / cross_product(u, v);
    if (0.0..=1.0).contains(&along) {
        return [0, 1].map(|k| a[k] + along * u[k]);
    }
    // Parallel ones, and those of which rounding has moved the point beyond an end: an end of one is on the other.
    let ends = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])];
    let away = |(end, other): &(Point, [Point; 2])| distance_to_segment(*end, *other);
    ends.into_iter().min_by(|x, y| away(x).total_cmp(&away(y))).map_or(a, |(end, _)| end)
}

/// Whether two sides of a polygon of `n` corners have more in common than a shared corner.
fn cross([i, j]: [usize; 2], n: usize, side: impl Fn(usize) -> [Point; 2]) -> bool {
    let (first, second) = (side(i), side(j));
    if j == i + 1 {
        folds_back(first, second)
    } else if i == 0 && j == n - 1 {
        folds_back(second, first)
    } else {
        segments_meet(first, second)
    }
}

/// Whether the second of two consecutive sides overlaps the first.
fn folds_back([a, b]: [Point; 2], [_, c]: [Point; 2]) -> bool {
    orientation(a, b, c) == Turn::Straight && (0..2).any(|k| (b[k] - a[k]) * (c[k] - b[k]) < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossing(points: &[Point]) -> Option<[usize; 2]> {
        first_crossing(&Outline::new(points.to_vec()).unwrap()).map(|crossing| crossing.sides)
    }

    #[test]
    fn bows_spikes_and_touching_corners_are_found() {
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]), None);
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [0.5, 3.0], [4.0, 5.0]]), Some([1, 3]));
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [4.0, 0.0], [4.0, 4.0]]), Some([0, 2]));
        let touching = [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert!(crossing(&touching).is_some());
        let place = |points: &[Point]| {
            first_crossing(&Outline::new(points.to_vec()).unwrap()).map(|crossing| crossing.place)
        };
        assert_eq!(place(&touching), Some([2.0, 0.0]));
        let halves = [[0.0, 0.0], [50.0, 50.0], [100.0, 0.0], [100.0, 100.0], [50.0, 50.0], [0.0, 100.0]];
        assert_eq!(place(&halves), Some([50.0, 50.0]));
        let bow = [[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0], [-2.0, 1.0]];
        assert_eq!(place(&bow), Some([2.0, 2.0]));
        let slit = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [5.0, 9.0], [5.0, 5.0], [5.0, 9.0], [0.0, 9.0]];
        assert!(matches!(place(&slit), Some([5.0, y]) if (5.0..=9.0).contains(&y)));
    }
}
