//! Cutting a piece in two or three, with the exact share of the area that each part has.

use super::linear::{Corners, greater};
use crate::search::piece::Crossing;
use glam::DVec3;

/// Part of a piece. New corners lie on its edges, at `from + t (to - from)` for some `t`, in exact arithmetic; then the shares of
/// the parts are products of `t` and `1 - t`, here rounded at most twice.
pub(super) struct Part {
    pub(super) corners: [[f64; 3]; 3],
    /// Fraction of the area of the piece.
    pub(super) share: f64,
    places: [Place; 3],
}

/// Where a corner of a part lies: on the edge between two corners of the piece, at this fraction.
#[derive(Clone, Copy)]
struct Place {
    from: usize,
    to: usize,
    t: f64,
}

impl Part {
    /// Values at the corners of this part of a linear function, or of one below it by rounding at most.
    pub(super) fn below(&self, v: Corners) -> Corners {
        self.values(v, -ROUNDING)
    }

    /// The same, or above it.
    pub(super) fn above(&self, v: Corners) -> Corners {
        self.values(v, ROUNDING)
    }

    fn values(&self, v: Corners, margin: f64) -> Corners {
        self.places.map(|Place { from, to, t }| {
            let (a, b) = (v[from], v[to]);
            if from == to || a == b { a } else { a + t * (b - a) + margin * (a.abs() + b.abs()) }
        })
    }
}

/// Three roundings, each relative to no more than the sum of both values.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Up to three parts.
pub(super) type Parts = [Option<Part>; 3];

/// Halves the longest edge.
pub(super) fn bisect(corners: &[[f64; 3]; 3]) -> Parts {
    let p = corners.map(DVec3::from_array);
    let length = |i: usize| p[i].distance_squared(p[(i + 1) % 3]);
    let longest = (1..3).fold(0, |l, i| if length(i) > length(l) { i } else { l });
    let [p, q, r] = [0, 1, 2].map(|i| at((longest + i) % 3));
    let middle = Place { from: p.from, to: q.from, t: 0.5 };
    [Some(part(corners, [p, middle, r], 0.5)), Some(part(corners, [middle, q, r], 0.5)), None]
}

/// Cuts along a line across the piece.
pub(super) fn along(crossing: &Crossing, corners: &[[f64; 3]; 3]) -> Parts {
    let [p, q, r] = [0, 1, 2].map(|i| at((crossing.apex + i) % 3));
    let (next, after) = (crossing.next, crossing.after);
    // A line through a corner, nearly: let it be exactly. But not through two, which would leave the piece whole.
    let (at_next, at_after) = (next > 1.0 - LEAST_PART, after > 1.0 - LEAST_PART);
    let s = Place { from: p.from, to: q.from, t: next };
    let t = Place { from: p.from, to: r.from, t: after };
    let part = |places, share| Some(part(corners, places, share));
    if at_next && !at_after {
        [part([p, q, t], after), part([q, r, t], 1.0 - after), None]
    } else if at_after && !at_next {
        [part([p, s, r], next), part([s, q, r], 1.0 - next), None]
    } else if distance(corners, s, r) < distance(corners, q, t) {
        [part([p, s, t], next * after), part([s, q, r], 1.0 - next), part([s, r, t], next * (1.0 - after))]
    } else {
        [part([p, s, t], next * after), part([q, r, t], 1.0 - after), part([q, t, s], after * (1.0 - next))]
    }
}

/// A smaller part of the area is not worth a piece.
pub(super) const LEAST_PART: f64 = 1e-12;

fn at(corner: usize) -> Place {
    Place { from: corner, to: corner, t: 0.0 }
}

fn position(corners: &[[f64; 3]; 3], Place { from, to, t }: Place) -> [f64; 3] {
    let (p, q) = (corners[from], corners[to]);
    if from == to { p } else { [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])) }
}

fn distance(corners: &[[f64; 3]; 3], x: Place, y: Place) -> f64 {
    DVec3::from_array(position(corners, x)).distance_squared(DVec3::from_array(position(corners, y)))
}

fn part(corners: &[[f64; 3]; 3], places: [Place; 3], share: f64) -> Part {
    Part { corners: places.map(|place| position(corners, place)), share: greater(share, 0.0), places }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::piece::crossing;
    use pompeiu_testkit::plain::area;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn shares_are_those_of_the_areas_and_values_those_of_the_function(
            corners in [[-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0]],
            side in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
            gradient in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
        ) {
            let value = |p: [f64; 3]| 1.0 + gradient[0] * p[0] + gradient[1] * p[1] + gradient[2] * p[2];
            let whole = area(corners);
            prop_assume!(whole > 1e-3);
            let mut cuts = vec![bisect(&corners)];
            cuts.extend(crossing(side).map(|crossing| along(&crossing, &corners)));
            for parts in cuts {
                let mut total = 0.0;
                for part in parts.iter().flatten() {
                    prop_assert!((area(part.corners) - part.share * whole).abs() < 1e-14);
                    let (below, above) = (part.below(corners.map(value)), part.above(corners.map(value)));
                    for j in 0..3 {
                        let v = value(part.corners[j]);
                        prop_assert!(below[j] <= v + 1e-15 && v <= above[j] + 1e-15 && above[j] - below[j] < 1e-14);
                    }
                    total += part.share;
                }
                prop_assert!((total - 1.0).abs() < 1e-14);
            }
        }
    }
}
