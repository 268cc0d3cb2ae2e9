//! Where a polygon is cut: as far along its sides as a face of B is near, at positions that take few bytes.

use pompeiu_verify::kernel::{Corner, Facet, PLACES, Point, between};

/// A place on a side from a corner that is near a face to one that is not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// From the near corner.
    pub(super) t: f64,
    /// That it takes in a certificate; 0 for the corner itself.
    pub(super) bytes: u32,
    /// The point there.
    pub(super) corner: Corner,
}

/// Steps of Newton's method; it converges quadratically from the far corner, and at once where the nearest points are on a plane.
const STEPS: usize = 12;

/// A step so short ends the search for a position.
const CLOSE: f64 = f64::EPSILON;

/// How far one can go from a near corner to one that is farther than `upper` from a face: a position that is not short of the
/// last one by more than rounding.
pub(super) fn reach(facet: &Facet, near: &Corner, far: &Corner, upper: f64) -> f64 {
    let (p, q) = (near.offset, far.offset);
    let along = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    let target = upper - 2.0 * doubt(facet, [near, far], upper);
    let mut t = 1.0;
    for _ in 0..STEPS {
        let d = facet.to([p[0] + t * along[0], p[1] + t * along[1], p[2] + t * along[2]]);
        let distance = length(d);
        let excess = distance - target;
        let slope = dot(d, along) / distance;
        if excess <= 0.0 || slope.is_nan() || slope <= 0.0 {
            break;
        }
        // The distance is convex: its tangents meet the target beyond the place that is looked for.
        let next = t - excess / slope;
        if next <= 0.0 {
            return 0.0;
        }
        if next >= t {
            break;
        }
        let is_last = t - next < CLOSE;
        t = next;
        if is_last {
            break;
        }
    }
    t
}

/// At least what the verifier's test adds to a distance of about `upper` for rounding, at corners and between them.
fn doubt(facet: &Facet, corners: [&Corner; 2], upper: f64) -> f64 {
    let size = |p: Point| p[0].abs().max(p[1].abs()).max(p[2].abs());
    let points = facet.corners.into_iter().chain(corners.map(|x| x.offset));
    let largest = points.map(size).fold(0.0, f64::max);
    1.8 * (corners[0].radius.max(corners[1].radius) + 8.0 * f64::EPSILON * largest)
        + 10.0 * f64::EPSILON * upper
}

/// The place on the side at `t` from the near corner, rounded towards it to so many bytes; `is_forward` where the side leads from the
/// near corner to the far one. None if that is the corner itself.
pub(super) fn place(near: &Corner, far: &Corner, is_forward: bool, t: f64, bytes: u32) -> Option<Place> {
    let places = if bytes == 7 { PLACES } else { (1_u64 << (8 * bytes)) as f64 };
    let t = (t * places).floor() / places;
    // Both t and 1 - t are multiples of the same power of two.
    let corner = if is_forward { between(near, far, t) } else { between(far, near, 1.0 - t) };
    (t > 0.0 && t < 1.0).then_some(Place { t, bytes, corner })
}

pub(super) fn dot(p: Point, q: Point) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

pub(super) fn length(p: Point) -> f64 {
    dot(p, p).sqrt()
}
