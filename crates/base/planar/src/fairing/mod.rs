//! The outline of a shape of pixels as a smooth curve.
//!
//! A curve that separates the pixels of a shape from those around it crosses a gate for each side between two of them (`gates.rs`). Of all
//! such curves the shortest one, the minimum-length polygon, says where the curve goes; from there it is moved to where it bends least
//! (`relax.rs`), with corners where both sides are straight (`corners.rs`).

mod banded;
mod corners;
mod gates;
mod relax;
mod tighten;

use crate::outline::distance;
use crate::{Outline, Point, first_crossing};
use corners::{open, with_corners};
use relax::{relax, stations};
use tighten::tightened;

/// Weights of the barrier in turn, and whether large curvature costs little in that round: at first all curvature costs, so that the steps of
/// the pixels are evened out, then corners may form. At the last weight a straight side of a thousand pixels comes out straight.
const ROUNDS: [(f64, bool); 8] = [
    (1e-2, false),
    (1e-3, false),
    (1e-4, false),
    (1e-4, false),
    (1e-5, true),
    (1e-6, true),
    (1e-7, true),
    (1e-8, true),
];

/// The rounds after corners are known.
const LAST_ROUNDS: [(f64, bool); 4] = [(1e-4, true), (1e-5, true), (1e-6, true), (1e-8, true)];

/// The smooth outline along a closed staircase of sides between pixels; none where it is too short for one, or it would cross itself. `crossing`
/// is told the centres of the pixels on the left and on the right of a side, and answers where between them the outline is known to cross, from
/// 0.5 at the left one to −0.5.
///
/// # Definition
/// The closed polygon, with a point near each side, which minimises Σ φ(κ) ℓ − μ Σ ln((s − a)(b − s)): κ the curvature at a point, ℓ the
/// length there, s where the point lies between the ends a and b of its gate. φ(κ) = c² ln(1 + κ²/c²) is κ² while κ is small and grows
/// slowly beyond c = 0.15 for each pixel, so that corners stay. Where both sides of a sharp bend are straight, they are extended to where they meet.
/// Of that curve's straight parts the shortest one within a tenth of a pixel is taken, which does not swing before corners.
///
/// # Accuracy
/// Points are at most 0.6 pixels from the sides between the pixels, along the normal, 0.25 pixels from known crossings, but for corners: these lie where the sides meet, beyond
/// the last pixel of a sharp tip. Details of less than half a pixel are lost.
///
/// # Cost
/// Some hundred solutions of a band for each pixel along the outline, about 20 µs.
pub(crate) fn fair(
    staircase: &[Point],
    crossing: impl Fn(Point, Point) -> Option<f64>,
) -> Option<Vec<Point>> {
    let gates = gates::gates(staircase, crossing);
    let room = gates.iter().map(|gate| 0.5 * distance(gate.left, gate.right)).fold(0.0, f64::max);
    let mut stations = stations(&gates)?;
    for (weight, keeps_corners) in ROUNDS {
        relax(&mut stations, weight, keeps_corners);
    }
    let is_simple = |points: &Vec<Point>| {
        Outline::new(points.clone()).is_ok_and(|outline| first_crossing(&outline).is_none())
    };
    let smooth: Vec<Point> = stations.iter().map(|station| station.at).collect();
    let (mut opened, corners) = open(&stations, room);
    if !corners.is_empty() {
        for (weight, keeps_corners) in LAST_ROUNDS {
            relax(&mut opened, weight, keeps_corners);
        }
        let points = with_corners(&opened, &corners);
        if is_simple(&points) {
            return Some(some_simple(tightened(&points), points));
        }
    }
    is_simple(&smooth).then(|| some_simple(tightened(&smooth), smooth))
}

/// The first of two curves that does not cross itself, or the second.
fn some_simple(first: Vec<Point>, second: Vec<Point>) -> Vec<Point> {
    let is_simple = Outline::new(first.clone()).is_ok_and(|outline| first_crossing(&outline).is_none());
    if is_simple { first } else { second }
}
