//! The shortest closed curve between the pixels of a shape and those around it.

use crate::Point;
use crate::coverage::Crossing;
use crate::outline::{cross, minus, signed_area};

/// A segment that the curve crosses: from the pixel of the shape on one side of a crack towards the pixel on its other side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    /// Its end on the left of the curve.
    pub(super) left: Point,
    /// Its end on the right.
    pub(super) right: Point,
}

impl Gate {
    /// Its middle.
    pub(super) fn middle(&self) -> Point {
        [0, 1].map(|k| 0.5 * (self.left[k] + self.right[k]))
    }
}

/// How far from a side between pixels a gate ends: a little before the centres of the pixels, so that a part of the shape one pixel wide
/// keeps two sides.
const REACH: f64 = 0.49;

/// The gates along a closed staircase, in its order; each side of it has length 1. `crossing` is where the curve is known to cross between the
/// centres of the pixels on the left and on the right, as a shift from their middle to the left; without one, it may cross anywhere between.
pub(super) fn gates(staircase: &[Point], crossing: impl Fn(Point, Point) -> Option<Crossing>) -> Vec<Gate> {
    let next = staircase.iter().cycle().skip(1);
    staircase
        .iter()
        .zip(next)
        .map(|(a, b)| {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let normal = [a[1] - b[1], b[0] - a[0]];
            let at = |t: f64| [middle[0] + t * normal[0], middle[1] + t * normal[1]];
            let (from, to) =
                crossing(at(0.5), at(-0.5)).map_or((-REACH, REACH), |Crossing { shift, room }| {
                    let shift = shift.clamp(room - REACH, REACH - room);
                    (shift - room, shift + room)
                });
            Gate { left: at(to), right: at(from) }
        })
        .collect()
}

/// The shortest closed curve through the gates, the minimum-length polygon, as the point in which it crosses each gate.
///
/// # Source
/// `sloboda_minimum_1998` defines it; `lee_euclidean_1984` finds a shortest path by a funnel.
pub(super) fn shortest(gates: &[Gate]) -> Vec<Point> {
    let Some((start, apex)) = fixed(gates) else { return Vec::new() };
    let n = gates.len();
    let gate = |k: usize| if k == n { Gate { left: apex, right: apex } } else { gates[(start + k) % n] };
    let corners = funnel(n, apex, gate);
    let mut crossings = Vec::with_capacity(n);
    for pair in corners.windows(2) {
        let [(a, from), (b, to)] = [pair[0], pair[1]];
        crossings.extend((from..to).map(|k| if k == from { a } else { crossing(gate(k), a, b) }));
    }
    crossings.rotate_right(start);
    crossings
}

/// The corners of the shortest path from a point through gates 1 to n, the last of which is a point, each with its gate.
fn funnel(n: usize, from: Point, gate: impl Fn(usize) -> Gate) -> Vec<(Point, usize)> {
    let mut corners = vec![(from, 0)];
    let (mut at, mut left, mut right) = (from, (from, 0), (from, 0));
    let mut k = 1;
    while k <= n {
        let next = gate(k);
        let turn = |a: Point, b: Point| cross(minus(a, at), minus(b, at));
        // A side of the funnel only moves inwards; where it crosses the other side, the end of that one is a corner.
        let mut corner = None;
        if turn(right.0, next.right) >= 0.0 {
            if right.0 == at || turn(left.0, next.right) < 0.0 {
                right = (next.right, k);
            } else {
                corner = Some(left);
            }
        }
        if corner.is_none() && turn(left.0, next.left) <= 0.0 {
            if left.0 == at || turn(right.0, next.left) > 0.0 {
                left = (next.left, k);
            } else {
                corner = Some(right);
            }
        }
        if let Some(corner) = corner {
            corners.push(corner);
            at = corner.0;
            (left, right) = (corner, corner);
            k = corner.1;
        }
        k += 1;
    }
    if corners.last().is_some_and(|(_, k)| *k < n) {
        corners.push((gate(n).left, n));
    }
    corners
}

/// Where the line from a to b crosses a gate.
fn crossing(Gate { left, right }: Gate, a: Point, b: Point) -> Point {
    let (along, across) = (minus(b, a), minus(left, right));
    let scale = cross(along, across);
    let t = if scale == 0.0 { 0.5 } else { (cross(along, minus(a, right)) / scale).clamp(0.0, 1.0) };
    [0, 1].map(|i| right[i] + t * across[i])
}

/// A gate, and the end of it that the shortest curve passes through: the extreme end on the inner side, a corner of the convex hull.
fn fixed(gates: &[Gate]) -> Option<(usize, Point)> {
    let middles: Vec<Point> = gates.iter().map(Gate::middle).collect();
    let is_left = signed_area(&middles) > 0.0;
    let ends = gates.iter().map(|gate| if is_left { gate.left } else { gate.right }).enumerate();
    ends.max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contour::staircases;
    use crate::outline::distance;

    #[test]
    fn the_shortest_curve_around_pixels_is_their_hull_where_they_are_convex() {
        // A disc of pixels: the hull of their centres, moved outwards by the hundredth of a pixel that gates end before them.
        let (n, radius_sq) = (41, 15.3_f64 * 15.3);
        let is_inside = |i: usize| {
            let [x, y] = [(i % n) as f64 - 20.2, (i / n) as f64 - 19.9];
            x * x + y * y < radius_sq
        };
        let values: Vec<f32> = (0..n * n).map(|i| f32::from(u8::from(is_inside(i)))).collect();
        let found = staircases(&values, n, 0.5);
        let points = shortest(&gates(&found[0].points, |_, _| None));
        let length: f64 =
            points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| distance(*a, *b)).sum();
        let centres = (0..n * n).filter(|i| is_inside(*i)).map(|i| [(i % n) as f64, (i / n) as f64]);
        let hull = crate::Outline::new(centres.collect()).unwrap().hull();
        let expected: f64 = hull.iter().zip(hull.iter().cycle().skip(1)).map(|(a, b)| distance(*a, *b)).sum();
        assert!(length > expected && length < expected + 0.1, "{length} {expected}");
    }

    #[test]
    fn a_picture_leaves_open_how_long_teeth_of_a_few_pixels_are() {
        // A gear of 14 teeth, 120 pixels across, with sides of 9 to 11 pixels.
        let at = |i: usize| {
            let (share, radius) = [(0.04, 49.2), (0.14, 60.0), (0.46, 60.0), (0.56, 49.2)][i % 4];
            let angle = std::f64::consts::TAU * ((i / 4) as f64 + share) / 14.0 + 0.4;
            [64.0 + radius * libm::cos(angle), 64.0 + radius * libm::sin(angle)]
        };
        let gear = crate::Outline::new((0..56).map(at).collect()).unwrap();
        let n = 128;
        let levels = |outline: &crate::Outline| -> Vec<f32> {
            let is_inside = |i: usize| outline.contains([(i % n) as f64, (i / n) as f64]);
            (0..n * n).map(|i| f32::from(u8::from(is_inside(i)))).collect()
        };
        let picture = levels(&gear);
        let found = staircases(&picture, n, 0.5);
        let shortest = crate::Outline::new(shortest(&gates(&found[0].points, |_, _| None))).unwrap();
        // Each pixel lies on the same side of both.
        assert_eq!(levels(&shortest), picture);
        let compactness = |outline: &crate::Outline| outline.area() / outline.length().powi(2);
        let open = compactness(&shortest) / compactness(&gear) - 1.0;
        assert!(open > 0.1, "{open}");
    }
}
