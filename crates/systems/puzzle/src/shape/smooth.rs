//! Smoothing borders without crossings.

use crate::Puzzle;
use crate::puzzle::simplify;
use crate::space::{Corner, Space};
use pompeiu_planar::{Point, resample_points};

/// Distance of points of a border before smoothing, relative to the mean side of a piece.
const SPACING: f64 = 0.02;

/// Rounds of smoothing in the order tried; the first number without intersections is used.
const ROUNDS: [usize; 4] = [3, 2, 1, 0];

/// Corners closer than this to the chord are removed, relative to the mean side of a piece.
const FLAT: f64 = 0.0025;

/// Smooths every border between two pieces; its ends stay. A border that would meet another one is smoothed less, or stays
/// unchanged.
pub(super) fn smooth(puzzle: &mut Puzzle) {
    let unit = puzzle.unit() / puzzle.step;
    let mut space = Space::new(puzzle.courses(), unit);
    for border in 0..puzzle.borders.len() {
        if puzzle.borders[border].right.is_none() {
            continue;
        }
        let old = puzzle.borders[border].corners.clone();
        let points: Vec<Point> = old.iter().map(|c| c.map(|x| x as f64)).collect();
        let length: f64 = points.windows(2).map(|p| libm::hypot(p[1][0] - p[0][0], p[1][1] - p[0][1])).sum();
        let count = (length / (SPACING * unit)).ceil() as usize + 1;
        for rounds in ROUNDS {
            let mut even = if rounds > 0 { resample_points(&points, count.max(2)) } else { points.clone() };
            for _ in 0..rounds {
                average(&mut even);
            }
            let mut path: Vec<Corner> = even.iter().map(|p| p.map(|x| x.round() as i64)).collect();
            // Resampling may round the ends.
            let last = path.len() - 1;
            (path[0], path[last]) = (old[0], old[old.len() - 1]);
            path.dedup();
            let path = simplify(&path, FLAT * unit);
            if path.len() > 1 && path[0] != path[path.len() - 1] && space.is_free(border, &path) {
                space.replace(border, &old, &path);
                puzzle.borders[border].corners = path;
                break;
            }
        }
    }
}

/// Replaces each inner point by a mean of itself, with weight two, and its neighbours.
fn average(points: &mut [Point]) {
    let old = points.to_vec();
    for i in 1..points.len().saturating_sub(1) {
        points[i] = [0, 1].map(|k| 0.25 * (old[i - 1][k] + 2.0 * old[i][k] + old[i + 1][k]));
    }
}
