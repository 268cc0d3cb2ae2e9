//! A triangle and the direction in which it is looked at.

use glam::DVec3;

/// A triangle T, seen along its normal together with what lies above and below it.
pub(crate) struct View {
    pub(super) t: [DVec3; 3],
    normal: DVec3,
    /// The second and third barycentric coordinates of what is seen over T are `dual[i] . (y - t[0])`.
    dual: [DVec3; 2],
}

/// Barycentric coordinates may change by this much over the unit of length: far from where they would overflow.
const MOST_STRETCH: f64 = 1e100;
/// Faces of B whose normals have a squared cosine with the view below this are too steep to be looked at.
const STEEP: f64 = 0.1;

impl View {
    /// None for a triangle that has no normal to speak of.
    pub(crate) fn new(corners: &[[f64; 3]; 3]) -> Option<Self> {
        let t = corners.map(DVec3::from_array);
        let (e1, e2) = (t[1] - t[0], t[2] - t[0]);
        let normal = e1.cross(e2);
        let inverse = 1.0 / normal.dot(normal);
        let dual = [e2.cross(normal) * inverse, normal.cross(e1) * inverse];
        let usable = |g: DVec3| g.abs().max_element() < MOST_STRETCH;
        (usable(dual[0]) && usable(dual[1])).then_some(Self { t, normal, dual })
    }

    /// Barycentric coordinates of the point of T's plane over which `y` is seen.
    #[inline]
    pub(super) fn barycentric(&self, y: DVec3) -> [f64; 3] {
        let r = y - self.t[0];
        let (v, w) = (self.dual[0].dot(r), self.dual[1].dot(r));
        [1.0 - v - w, v, w]
    }

    /// Whether a triangle is seen almost from the side, or from the other side than one would expect of its corners, taken in
    /// reverse or not.
    pub(super) fn is_steep(&self, corners: &[DVec3; 3], reversed: bool) -> bool {
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a);
        let along = if reversed { -self.normal.dot(normal) } else { self.normal.dot(normal) };
        along < 0.0 || along * along <= STEEP * self.normal.length_squared() * normal.length_squared()
    }

    /// Whether the corners of a triangle are seen in the opposite order to those of T.
    pub(super) fn is_reversed(&self, corners: &[DVec3; 3]) -> bool {
        self.normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0])) < 0.0
    }

    /// The point of the boundary of T nearest to a point in T, and the corner opposite to it.
    pub(super) fn to_boundary(&self, x: DVec3) -> (DVec3, u8) {
        let mut best = (f64::INFINITY, x, 0);
        for j in 0..3 {
            let (from, to) = (self.t[(j + 1) % 3], self.t[(j + 2) % 3]);
            let w = (x - from).dot(to - from) / (to - from).length_squared();
            let y = from + clamped(w) * (to - from);
            let distance_sq = x.distance_squared(y);
            if distance_sq < best.0 {
                best = (distance_sq, y, j as u8);
            }
        }
        (best.1, best.2)
    }
}

/// Into the unit interval.
#[inline]
pub(crate) fn clamped(w: f64) -> f64 {
    if w > 0.0 { if w < 1.0 { w } else { 1.0 } } else { 0.0 }
}
