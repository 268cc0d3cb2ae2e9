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
mod varied;

use crate::coverage::Crossing;
use crate::outline::{distance, dot};
use crate::{Outline, Point, first_crossing, from_segment};
use corners::{Bends, meeting, open, with_corners};
use relax::{Cost, Station, relax, stations};
use tighten::tightened;
use varied::varied;

/// Weights of the barrier in turn, and what costs in that round: at first all curvature, so that the steps of the pixels are evened out, then
/// corners may form. At the last weight a straight side of a thousand pixels comes out straight.
const ROUNDS: [(f64, Cost); 8] = [
    (1e-2, Cost::Bending),
    (1e-3, Cost::Bending),
    (1e-4, Cost::Bending),
    (1e-4, Cost::Bending),
    (1e-5, Cost::Corners),
    (1e-6, Cost::Corners),
    (1e-7, Cost::Corners),
    (1e-8, Cost::Corners),
];

/// Weights of the barrier after corners are known.
const LAST_ROUNDS: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-8];

/// How often corners are taken out at most, each time without those whose sides did not meet within the gates.
const ATTEMPTS: usize = 6;

/// The smooth outline along a closed staircase of sides between pixels; none where it is too short for one, or it would cross itself. `crossing`
/// is told the centres of the pixels on the left and on the right of a side, and answers where between them the outline is known to cross, from
/// 0.5 at the left one to −0.5.
///
/// # Definition
/// The closed polygon, with a point near each side, which minimises Σ φ(κ) ℓ − μ Σ ln((s − a)(b − s)): κ the curvature at a point, ℓ the
/// length there, s where the point lies between the ends a and b of its gate. φ(κ) = c² ln(1 + κ²/c²) is κ² while κ is small and grows
/// slowly beyond c = 0.15 for each pixel, so that corners stay. Where both sides of a sharp bend are straight, they are extended to where they meet,
/// if they stay within the gates. A side between corners that has to bend takes the least Σ (κ′)² ℓ instead, with less of it where κ is large
/// (`varied.rs`). Of that curve's straight parts the shortest one within a tenth of a pixel is taken, which does not swing before corners. A
/// curve that is nowhere farther inside its convex hull than half the longest gate becomes convex.
///
/// # Accuracy
/// Points are at most 0.6 pixels from the sides between the pixels, along the normal, 0.25 pixels from known crossings, but for corners: these lie where the sides meet, beyond
/// the last pixel of a sharp tip. Details of less than half a pixel are lost.
///
/// # Cost
/// Some hundred solutions of a band for each pixel along the outline, and half as many for each time that bends turn out to be no corners.
pub(crate) fn fair(
    staircase: &[Point],
    crossing: impl Fn(Point, Point) -> Option<Crossing>,
) -> Option<Vec<Point>> {
    let gates = gates::gates(staircase, crossing);
    let room = gates.iter().map(|gate| 0.5 * distance(gate.left, gate.right)).fold(0.0, f64::max);
    let mut stations = stations(&gates)?;
    for (weight, cost) in ROUNDS {
        relax(&mut stations, weight, cost);
    }
    if let Some(points) = cornered(&stations, room).filter(|points| is_simple(points)) {
        return Some(convex(some_simple(tightened(&points), points), room));
    }
    let smooth: Vec<Point> = varied(stations).iter().map(|station| station.at).collect();
    is_simple(&smooth).then(|| convex(some_simple(tightened(&smooth), smooth), room))
}

/// The convex hull of a curve that is nowhere farther from it than `room`, by which the curve may lie elsewhere; else the curve. Without that,
/// swings of long sides beside arcs and blunt corners would tell convex shapes apart by chance.
fn convex(points: Vec<Point>, room: f64) -> Vec<Point> {
    let Ok(outline) = Outline::new(points) else { return Vec::new() };
    let hull = outline.hull();
    let points = outline.into_points();
    // Both go counter-clockwise, and corners of the hull are points of the curve: the side beside a point only moves on.
    let start = points.iter().position(|p| *p == hull[0]).unwrap_or(0);
    let mut at = 0;
    let is_convex = (0..points.len()).all(|k| {
        let p = points[(start + k) % points.len()];
        let next = (at + 1) % hull.len();
        if p == hull[next] {
            at = next;
        }
        let off = from_segment(p, [hull[at], hull[(at + 1) % hull.len()]]);
        dot(off, off) <= room * room
    });
    if is_convex { hull } else { points }
}

/// The curve with corners where both sides of a bend meet within the gates; none where no bend is a corner. Bends that turn out to be none go
/// back into the curve, which is relaxed again.
fn cornered(stations: &[Station], room: f64) -> Option<Vec<Point>> {
    let mut bends = Bends::of(stations, room);
    for attempt in 1..=ATTEMPTS {
        if bends.is_empty() {
            break;
        }
        let (mut opened, corners) = open(stations, &bends);
        for weight in LAST_ROUNDS {
            relax(&mut opened, weight, Cost::Corners);
        }
        let opened = varied(opened);
        let places: Vec<Option<Point>> =
            corners.iter().map(|corner| meeting(&opened, corner, room)).collect();
        let is_corner: Vec<bool> = places.iter().map(Option::is_some).collect();
        if attempt == ATTEMPTS || !is_corner.contains(&false) {
            return Some(with_corners(&opened, &corners, &places));
        }
        bends.retain(&is_corner);
    }
    None
}

/// Whether a closed curve does not cross itself.
fn is_simple(points: &[Point]) -> bool {
    Outline::new(points.to_vec()).is_ok_and(|outline| first_crossing(&outline).is_none())
}

/// The first of two curves that does not cross itself, or the second.
fn some_simple(first: Vec<Point>, second: Vec<Point>) -> Vec<Point> {
    if is_simple(&first) { first } else { second }
}
