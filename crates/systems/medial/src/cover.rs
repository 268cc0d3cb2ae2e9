//! The deviation between balls and a surface.

use crate::ball::{Ball, distance};
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Workspace};
use std::collections::BinaryHeap;

/// The deviation between the union of balls and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Deviation {
    /// Bounds on the greatest distance of a point of the surface from the union of the balls; points inside a ball have distance
    /// zero.
    pub surface_to_balls: [f64; 2],
    /// An upper bound on the distance from the surface of all points of the balls that lie outside of it.
    pub balls_to_surface: f64,
}

/// Bound on the rounding error of a distance for coordinates of size one: a few operations of half a unit in the last place each.
const ROUNDING: f64 = 1e-14;

/// A part of a face with bounds on its greatest distance from the balls, ordered by the upper bound.
struct Part {
    upper: f64,
    corners: [[f64; 3]; 3],
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

/// Bounds on the deviation, at most `tolerance` apart unless the run is stopped.
///
/// # Definition
/// The distance of a point from a ball is convex, so over a triangle it is greatest at a corner. The least of these maxima over all
/// balls bounds the distance of the triangle from the union. Triangles with the greatest bound are bisected until a point is found
/// that is nearly as far. A ball with its centre inside extends out of the surface by at most the excess of its radius over the
/// centre's distance from the surface; one with its centre outside, by at most their sum.
///
/// # Accuracy
/// The bounds are widened by the rounding error of distances in a frame of size one.
pub(super) fn deviation(
    bvh: &Bvh,
    is_inside: impl Fn([f64; 3]) -> bool,
    balls: &[Ball],
    tolerance: f64,
    control: &Control,
) -> Deviation {
    let depth = |p: [f64; 3], ball: &Ball| distance(p, ball.centre) - ball.radius;
    let over = |value: f64| if value > 0.0 { value } else { 0.0 };
    let mut lower = 0.0_f64;
    let mut heap = BinaryHeap::new();
    let consider = |corners: [[f64; 3]; 3], lower: &mut f64, heap: &mut BinaryHeap<Part>| {
        let mut least = [f64::INFINITY; 3];
        let mut upper = f64::INFINITY;
        for ball in balls {
            let depths = corners.map(|p| depth(p, ball));
            for (least, depth) in least.iter_mut().zip(depths) {
                *least = least.min(depth);
            }
            upper = upper.min(depths[0].max(depths[1]).max(depths[2]));
        }
        *lower = lower.max(least[0]).max(least[1]).max(least[2]);
        if over(upper) > *lower + 0.5 * tolerance {
            heap.push(Part { upper, corners });
        }
    };
    for slot in bvh.slots() {
        consider(bvh.corners(slot), &mut lower, &mut heap);
    }
    let mut upper = lower + 0.5 * tolerance;
    while let Some(part) = heap.pop() {
        if part.upper <= lower + tolerance || control.is_stopped() {
            upper = upper.max(part.upper);
            break;
        }
        for corners in halves(part.corners) {
            consider(corners, &mut lower, &mut heap);
        }
        upper = lower + 0.5 * tolerance;
    }
    let mut workspace = Workspace::default();
    let mut out = 0.0_f64;
    for ball in balls {
        let clear = bvh.nearest(ball.centre, bvh.any_slot(), &mut workspace).distance_sq.sqrt();
        out = out.max(if is_inside(ball.centre) { ball.radius - clear } else { ball.radius + clear });
    }
    Deviation {
        surface_to_balls: [over(lower - ROUNDING), upper + ROUNDING],
        balls_to_surface: over(out) + ROUNDING,
    }
}

/// Bisects a triangle across its longest side.
fn halves(corners: [[f64; 3]; 3]) -> [[[f64; 3]; 3]; 2] {
    let length = |i: usize| distance(corners[i], corners[(i + 1) % 3]);
    let longest = (0..3).fold(0, |best, i| if length(i) > length(best) { i } else { best });
    let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
    let middle = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
    [[a, middle, c], [middle, b, c]]
}
