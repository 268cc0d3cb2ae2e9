//! Distances between points, segments and outlines.

use crate::outline::{distance, dot, minus};
use crate::{Outline, Point, segments_meet};

/// The width of the enclosure of a distance, relative to the joint diagonal.
const WIDTH: f64 = 1e-9;

/// The distance from a point to the curve.
pub fn distance_to_outline(p: Point, outline: &Outline) -> f64 {
    outline.sides().map(|side| distance_to_segment(p, side)).fold(f64::INFINITY, f64::min)
}

/// The distance from a point to a segment.
pub(crate) fn distance_to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (u, v) = (minus(b, a), minus(p, a));
    let norm_sq = dot(u, u);
    let t = if norm_sq > 0.0 { (dot(u, v) / norm_sq).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, [a[0] + t * u[0], a[1] + t * u[1]])
}

/// The vector to a point from the nearest point of a segment.
#[inline]
pub fn from_segment(p: Point, [a, b]: [Point; 2]) -> Point {
    let (u, v) = (minus(b, a), minus(p, a));
    let norm_sq = dot(u, u);
    let t = if norm_sq > 0.0 { (dot(u, v) / norm_sq).clamp(0.0, 1.0) } else { 0.0 };
    [v[0] - t * u[0], v[1] - t * u[1]]
}

/// The squared distance from a point to a segment.
#[inline]
pub fn distance_sq_to_segment(p: Point, segment: [Point; 2]) -> f64 {
    let w = from_segment(p, segment);
    dot(w, w)
}

/// The distance between two segments, 0 if they meet.
pub(crate) fn distance_between_segments(s: [Point; 2], t: [Point; 2]) -> f64 {
    if segments_meet(s, t) {
        return 0.0;
    }
    let [of_s, of_t] = [s.map(|p| distance_to_segment(p, t)), t.map(|p| distance_to_segment(p, s))];
    of_s.into_iter().chain(of_t).fold(f64::INFINITY, f64::min)
}

/// The Pompeiu–Hausdorff distance between two curves, of all their points and not of corners only.
///
/// # Definition
/// The greater of the two directed distances max over p in a of the distance from p to b.
///
/// # Accuracy
/// Sides are halved until the distance is known to a billionth of the joint diagonal; the lower end of the enclosure is returned.
///
/// # Cost
/// Product of the numbers of corners; a few times more where sides are subdivided.
pub fn hausdorff(a: &Outline, b: &Outline) -> f64 {
    let [[low, high], [l, h]] = [a.bounds(), b.bounds()];
    let diagonal = distance([0, 1].map(|k| low[k].min(l[k])), [0, 1].map(|k| high[k].max(h[k])));
    directed(a, b, WIDTH * diagonal).max(directed(b, a, WIDTH * diagonal))
}

fn directed(from: &Outline, to: &Outline, width: f64) -> f64 {
    let sides: Vec<[Point; 2]> = to.sides().collect();
    let at = |p: Point| sides.iter().map(|s| distance_to_segment(p, *s)).fold(f64::INFINITY, f64::min);
    let corners: Vec<f64> = from.points().iter().map(|p| at(*p)).collect();
    let mut best = corners.iter().copied().fold(0.0, f64::max);
    let n = corners.len();
    let mut open: Vec<([Point; 2], [f64; 2])> =
        from.sides().enumerate().map(|(i, side)| (side, [corners[i], corners[(i + 1) % n]])).collect();
    while let Some(([a, b], [da, db])) = open.pop() {
        // The distance is 1-Lipschitz. The distance from one side is convex, so its maximum along a segment is at an end.
        let length = distance(a, b);
        if 0.5 * (da + db + length) <= best + width {
            continue;
        }
        let bound = sides
            .iter()
            .map(|s| distance_to_segment(a, *s).max(distance_to_segment(b, *s)))
            .fold(f64::INFINITY, f64::min);
        if bound <= best + width {
            continue;
        }
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let dm = at(middle);
        best = best.max(dm);
        open.push(([a, middle], [da, dm]));
        open.push(([middle, b], [dm, db]));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_of_all_points() {
        let square = |x: f64, side: f64| {
            Outline::new(vec![[x, 0.0], [x + side, 0.0], [x + side, side], [x, side]]).unwrap()
        };
        assert_eq!(hausdorff(&square(0.0, 1.0), &square(0.25, 1.0)), 0.25);
        // The middle of the long side of the triangle is far from the notch, and no corner is.
        let (a, b) = ([0.0, 0.0], [8.0, 0.0]);
        let plain = Outline::new(vec![a, b, [4.0, 9.0]]).unwrap();
        let notched = Outline::new(vec![a, [4.0, 3.0], b, [4.0, 9.0]]).unwrap();
        assert!((directed(&plain, &notched, 1e-9) - 12.0 / 5.0).abs() < 1e-8);
        // The tip of the notch is nearest to the legs.
        assert!((hausdorff(&plain, &notched) - 24.0 / 97.0_f64.sqrt()).abs() < 1e-8);
    }
}
