//! Straight sides without the swings that a curve of least bending makes beside corners.

use super::gates::{Gate, shortest};
use crate::Point;
use crate::outline::{cross, dot, minus};

/// How far a point may move, in pixels, and the curvature, per pixel, from which on it does not.
const ROOM: f64 = 0.1;
const BENT: f64 = 0.1;

/// The share of that by which it may move everywhere.
const LEAST_SHARE: f64 = 1e-6;

/// A part that turns one way by less than this between two that turn the other way is a swing; points as near to it as this, in pixels,
/// may move.
const SLIGHT: f64 = 0.1;
const BESIDE: f64 = 8.0;

/// A curve shorter than this, in pixels, has no sides long enough to tell swings from its shape.
const SHORT: f64 = 64.0;

/// The shortest curve near another one, with room where that one swings. Bends, corners, and curves without swings stay.
pub(super) fn tightened(points: &[Point]) -> Vec<Point> {
    let n = points.len();
    let sides: Vec<(Point, f64)> = (0..n)
        .map(|i| {
            let v = minus(points[(i + 1) % n], points[i]);
            let length = dot(v, v).sqrt().max(f64::MIN_POSITIVE);
            (v.map(|x| x / length), length)
        })
        .collect();
    let turn = |i: usize| {
        let (before, after) = (sides[(i + n - 1) % n].0, sides[i].0);
        libm::atan2(cross(before, after), dot(before, after))
    };
    let turns: Vec<f64> = (0..n).map(turn).collect();
    let lengths: Vec<f64> = sides.iter().map(|(_, length)| *length).collect();
    let is_movable = beside_swings(&turns, &lengths);
    if !is_movable.contains(&true) || lengths.iter().sum::<f64>() < SHORT {
        return points.to_vec();
    }
    let gate = |i: usize| {
        let ((before, last), (after, next)) = (sides[(i + n - 1) % n], sides[i]);
        let curvature = turns[i].abs() / (0.5 * (last + next));
        let share = if is_movable[i] { 1.0 - curvature / BENT } else { 0.0 };
        let sum = [before[0] + after[0], before[1] + after[1]];
        let length = dot(sum, sum).sqrt().max(f64::MIN_POSITIVE);
        let across = [-sum[1] / length, sum[0] / length];
        let at = |away: f64| [0, 1].map(|k| points[i][k] + away * across[k]);
        let room = ROOM * share.max(LEAST_SHARE);
        Gate { left: at(room), right: at(-room) }
    };
    let found = shortest(&(0..n).map(gate).collect::<Vec<_>>());
    if found.len() == n { found } else { points.to_vec() }
}

/// Which points lie in or near a swing.
fn beside_swings(turns: &[f64], lengths: &[f64]) -> Vec<bool> {
    let n = turns.len();
    let mut is_near = vec![false; n];
    // Runs of one sign, from where one begins.
    let Some(start) = (0..n).find(|i| (turns[*i] > 0.0) != (turns[(i + n - 1) % n] > 0.0)) else {
        return is_near;
    };
    let mut k = 0;
    while k < n {
        let first = k;
        let at = |k: usize| (start + k) % n;
        let mut sum = 0.0;
        while k < n && (turns[at(k)] > 0.0) == (turns[at(first)] > 0.0) {
            sum += turns[at(k)];
            k += 1;
        }
        if f64::abs(sum) >= SLIGHT {
            continue;
        }
        (first..k).for_each(|k| is_near[at(k)] = true);
        let (mut i, mut away) = (at(first), 0.0);
        while away < BESIDE {
            i = (i + n - 1) % n;
            away += lengths[i].max(BESIDE / n as f64);
            is_near[i] = true;
        }
        let (mut i, mut away) = (at(k - 1), 0.0);
        while away < BESIDE {
            away += lengths[i].max(BESIDE / n as f64);
            i = (i + 1) % n;
            is_near[i] = true;
        }
    }
    is_near
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total(points: &[Point]) -> f64 {
        let n = points.len();
        let side = |i: usize| minus(points[(i + 1) % n], points[i % n]);
        (0..n)
            .map(|i| (side(i + n - 1), side(i)))
            .map(|(a, b)| libm::atan2(cross(a, b), dot(a, b)).abs())
            .sum()
    }

    #[test]
    fn swings_of_straight_sides_go_and_curves_stay() {
        // A square whose sides swing by a twentieth of a pixel.
        let side = |i: usize, from: Point, along: Point| {
            let t = i as f64;
            let away = 0.05 * libm::sin(t * std::f64::consts::PI / 10.0);
            [from[0] + t * along[0] - away * along[1], from[1] + t * along[1] + away * along[0]]
        };
        let starts = [[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]];
        let ways = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let square: Vec<Point> = starts
            .iter()
            .zip(ways)
            .flat_map(|(from, way)| (0..40).map(move |i| side(i, *from, way)))
            .collect();
        let found = tightened(&square);
        let circle = std::f64::consts::TAU;
        assert!(total(&square) > 1.05 * circle && total(&found) < 1.002 * circle, "{}", total(&found));
        let off = square.iter().zip(&found).map(|(p, q)| minus(*p, *q)).map(|v| dot(v, v).sqrt());
        assert!(off.fold(0.0, f64::max) <= ROOM);
        let clover: Vec<Point> = (0..300)
            .map(|i| circle * f64::from(i) / 300.0)
            .map(|a| [a, 30.0 * (1.0 + 0.4 * libm::cos(3.0 * a))])
            .map(|[a, r]| [r * libm::cos(a), r * libm::sin(a)])
            .collect();
        assert_eq!(tightened(&clover), clover);
    }
}
