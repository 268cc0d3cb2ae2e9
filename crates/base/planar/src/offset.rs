//! Outlines at a distance from an outline.

use crate::joined::joined;
use crate::outline::{cross, distance, minus};
use crate::strips::Strips;
use crate::{Outline, Point, first_crossing};

/// Largest distance of chords from the arcs around corners, relative to the offset distance.
const FLATTENING: f64 = 0.02;

/// Distance from the curve of the points where winding numbers are evaluated, relative to the size of the outline.
const BESIDE: f64 = 1e-9;

/// Ends closer than this are merged: sides cannot be that short.
const NEAR: f64 = 1e-7;

/// The boundary of all points within a distance of a simple outline; for a negative distance, of the points inside that are farther
/// than that from the outline.
///
/// An outline that shrinks may split or vanish. Holes that form when it grows are omitted.
///
/// # Definition
/// The sides are moved by the distance, joined by arcs where they separate and through the corner where they intersect. Points
/// around which that curve winds at least once are inside. The curve is cut at its self-intersections, and the parts with the
/// inside on their left and the outside on their right are joined.
///
/// # Accuracy
/// Chords lie within 2 % of the distance from their arcs. Coordinates have the rounding of doubles.
///
/// # Cost
/// Corners times the sides at the height of one; for each side, those that are beside it.
pub fn offset(outline: &Outline, by: f64) -> Vec<Outline> {
    if by == 0.0 || !by.is_finite() {
        return vec![outline.clone()];
    }
    let raw = moved(outline.points(), by);
    let [low, high] = outline.bounds();
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    joined(&kept(&raw, BESIDE * size), NEAR * size)
        .into_iter()
        .filter_map(|points| {
            let is_left = crate::outline::signed_area(&points) > 0.0;
            is_left.then(|| Outline::new(points).ok()).flatten()
        })
        .filter(|found| first_crossing(found).is_none())
        .collect()
}

/// The sides moved outwards, with their joins.
fn moved(points: &[Point], by: f64) -> Vec<Point> {
    let n = points.len();
    let outward = |i: usize| {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let length = distance(a, b);
        [(b[1] - a[1]) / length, (a[0] - b[0]) / length]
    };
    let step = 2.0 * libm::acos(1.0 - FLATTENING);
    let mut found = Vec::with_capacity(3 * n);
    for i in 0..n {
        let (before, after, corner) = (outward((i + n - 1) % n), outward(i), points[i]);
        let place = |normal: Point| [0, 1].map(|k| corner[k] + by * normal[k]);
        let turn = libm::atan2(cross(before, after), before[0] * after[0] + before[1] * after[1]);
        found.push(place(before));
        if turn * by > 0.0 {
            let pieces = (turn.abs() / step).ceil().max(1.0) as usize;
            for k in 1..pieces {
                let (sine, cosine) = libm::sincos(turn * k as f64 / pieces as f64);
                found.push(place([
                    cosine * before[0] - sine * before[1],
                    sine * before[0] + cosine * before[1],
                ]));
            }
        } else if turn != 0.0 {
            found.push(corner);
        }
        found.push(place(after));
    }
    found.dedup();
    while found.len() > 1 && found.first() == found.last() {
        found.pop();
    }
    found
}

/// The parts of a closed curve, cut at its self-intersections, that have the inside on their left and the outside on their right.
fn kept(raw: &[Point], beside: f64) -> Vec<[Point; 2]> {
    let n = raw.len();
    let side = |i: usize| [raw[i], raw[(i + 1) % n]];
    let strips = Strips::new(raw);
    let mut cuts: Vec<Vec<(f64, Point)>> = vec![Vec::new(); n];
    for [i, j] in strips.near_pairs() {
        let ([a, b], [c, d]) = (side(i), side(j));
        let (u, v, w) = (minus(b, a), minus(d, c), minus(c, a));
        let scale = cross(u, v);
        if scale == 0.0 {
            continue;
        }
        let (s, t) = (cross(w, v) / scale, cross(w, u) / scale);
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            let place = [0, 1].map(|k| a[k] + s * u[k]);
            cuts[i].push((s, place));
            cuts[j].push((t, place));
        }
    }
    let mut found = Vec::new();
    for (i, mut places) in cuts.into_iter().enumerate() {
        places.sort_by(|x, y| x.0.total_cmp(&y.0));
        let [a, b] = side(i);
        let mut from = a;
        for to in places.into_iter().map(|(_, place)| place).chain([b]) {
            let length = distance(from, to);
            if length > 0.0 {
                let middle = [0, 1].map(|k| 0.5 * (from[k] + to[k]));
                let across = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
                let at = |sign: f64| [0, 1].map(|k| middle[k] + sign * beside * across[k]);
                if strips.winding(at(1.0)) > 0 && strips.winding(at(-1.0)) <= 0 {
                    found.push([from, to]);
                }
            }
            from = to;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance_to_outline;
    use std::f64::consts::PI;

    fn outline(points: &[Point]) -> Outline {
        Outline::new(points.to_vec()).unwrap()
    }

    #[test]
    fn areas_of_larger_and_smaller_outlines_are_those_of_steiner() {
        let l = outline(&[[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [2.0, 2.0], [2.0, 5.0], [0.0, 5.0]]);
        let [larger] = &offset(&l, 0.5)[..] else { panic!("one outline") };
        // Five quarters of a circle are added; at the reflex corner both sides cover a square twice.
        let truth = l.area() + 0.5 * l.length() + 5.0 * PI / 4.0 * 0.25 - 0.25;
        assert!((larger.area() / truth - 1.0).abs() < 2e-3, "{} {truth}", larger.area());
        let [smaller] = &offset(&l, -0.5)[..] else { panic!("one outline") };
        // A quarter of a circle surrounds the reflex corner.
        let truth = 5.0 + 3.0 + 0.25 * (1.0 - PI / 4.0);
        assert!((smaller.area() / truth - 1.0).abs() < 2e-3, "{} {truth}", smaller.area());
        for p in smaller.points() {
            assert!((distance_to_outline(*p, &l) - 0.5).abs() < 0.02, "{p:?}");
        }
    }

    #[test]
    fn what_is_made_smaller_falls_apart_or_vanishes() {
        let dumbbell = outline(&[
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 0.9],
            [4.0, 0.9],
            [4.0, 0.0],
            [6.0, 0.0],
            [6.0, 2.0],
            [4.0, 2.0],
            [4.0, 1.1],
            [2.0, 1.1],
            [2.0, 2.0],
            [0.0, 2.0],
        ]);
        assert_eq!(offset(&dumbbell, -0.05).len(), 1);
        let parts = offset(&dumbbell, -0.2);
        assert_eq!(parts.len(), 2);
        assert!(parts.iter().all(|part| (2.56..2.57).contains(&part.area())));
        assert!(offset(&dumbbell, -1.1).is_empty());
        // The notch between the balls closes.
        assert_eq!(offset(&dumbbell, 1.5).len(), 1);
    }

    #[test]
    fn a_ragged_outline_keeps_its_distance() {
        let at = |i: usize| {
            let a = std::f64::consts::TAU * i as f64 / 300.0;
            let r = 1.0 + 0.1 * libm::sin(37.0 * a) + 0.05 * libm::cos(90.0 * a);
            [r * libm::cos(a), r * libm::sin(a)]
        };
        let ragged = outline(&(0..300).map(at).collect::<Vec<_>>());
        for by in [0.01, -0.01, 0.03, -0.03, 0.1] {
            let found = offset(&ragged, by);
            assert_eq!(found.len(), 1, "{by}");
            for p in found[0].points() {
                let off = distance_to_outline(*p, &ragged);
                assert!((off - by.abs()).abs() < 0.03 * by.abs(), "{by}: {off}");
                assert_eq!(ragged.contains(*p), by < 0.0);
            }
        }
    }
}
