//! A shift and a power-of-two scale that bring coordinates to the size of one, and a rotation where that is wanted.

use super::Aabb;
use super::turn::Turn;
use crate::exact::Interval;
use glam::DMat3;

/// The map `x -> x / 2^exponent - origin`, with `origin` in scaled units, in a [turned](Frame::turned) frame followed by a rotation.
///
/// Scaling by a power of two is exact, so squares neither overflow nor underflow in any unit of the input. The origin is zero
/// unless the box lies more than [`Frame::SHIFT_BEYOND`] times its own size away from it; then the subtraction removes the leading
/// digits that all coordinates share.
///
/// # Accuracy
/// Each mapped coordinate `y` differs from the exact image by at most `2^-53 |y|` (the one subtraction), plus `2^-1074`
/// where scaling down meets the subnormal range. Points of the box itself are mapped exactly, and back: with an origin
/// other than zero they are multiples of `2^-51`, and so are their differences from it, which are below 1. A turned frame moves points
/// further, by [`Frame::error`], and the way back is rounded too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    origin: [f64; 3],
    /// Two powers of two whose product is the scale. The product may exceed the range of a double; multiplying by one factor after
    /// the other rounds at most once.
    shrink: (f64, f64),
    grow: (f64, f64),
    turn: Option<Turn>,
}

impl Frame {
    /// A box this many times its longest side away from zero is shifted.
    pub const SHIFT_BEYOND: f64 = 4.0;

    /// The frame in which a box has its longest side between 1/2 and 1. A box without extent is scaled by the size of
    /// its coordinates.
    pub fn of(aabb: &Aabb) -> Self {
        if aabb.is_empty() {
            return Self::scaling(0);
        }
        let extent =
            (0..3).map(|k| aabb.upper[k] - aabb.lower[k]).fold(0.0, |m: f64, x| if x > m { x } else { m });
        let size = if extent > 0.0 { extent } else { aabb.max_coordinate() };
        let exponent = if size > 0.0 { exponent_above(size) } else { 0 };
        let scaled = Self::scaling(exponent);
        let (lower, upper) = (scaled.map(aabb.lower), scaled.map(aabb.upper));
        let origin = [0, 1, 2].map(|k| {
            let centre = lower[k] + 0.5 * (upper[k] - lower[k]);
            // Origins at multiples of a quarter have few significant bits, so that the subtraction is exact more often.
            if centre.abs() > Self::SHIFT_BEYOND { (4.0 * centre).round() * 0.25 } else { 0.0 }
        });
        Self { origin, ..scaled }
    }

    fn scaling(exponent: i32) -> Self {
        Self { origin: [0.0; 3], shrink: factors(-exponent), grow: factors(exponent), turn: None }
    }

    /// The same frame followed by the nearest rotation to the given one whose exact entries are known, for points of a box in the unit of
    /// the mesh.
    #[must_use]
    pub fn turned(self, rotation: DMat3, aabb: &Aabb) -> Self {
        Self { turn: Some(Turn::near(rotation, &self.shifted_box(aabb))), ..self }
    }

    /// Whether a rotation follows.
    pub fn is_turned(&self) -> bool {
        self.turn.is_some()
    }

    /// How far the rotation may leave points of its box from their exact images; zero in a frame that is not turned.
    pub fn error(&self) -> f64 {
        self.turn.as_ref().map_or(0.0, Turn::error)
    }

    /// A point in this frame.
    #[inline]
    pub fn map(&self, p: [f64; 3]) -> [f64; 3] {
        let p = self.shifted(p);
        self.turn.as_ref().map_or(p, |turn| turn.apply(p))
    }

    /// A point before the rotation.
    #[inline]
    fn shifted(&self, p: [f64; 3]) -> [f64; 3] {
        let (s, t) = self.shrink;
        [p[0] * s * t - self.origin[0], p[1] * s * t - self.origin[1], p[2] * s * t - self.origin[2]]
    }

    /// A box before the rotation.
    fn shifted_box(&self, aabb: &Aabb) -> Aabb {
        Aabb { lower: self.shifted(aabb.lower), upper: self.shifted(aabb.upper) }
    }

    /// Largest magnitude of a coordinate of a box in this frame; in a turned one the greatest distance from its origin, which bounds the
    /// coordinates before and after the rotation.
    pub fn max_coordinate(&self, aabb: &Aabb) -> f64 {
        let shifted = self.shifted_box(aabb);
        if self.is_turned() { Turn::reach_of(&shifted) } else { shifted.max_coordinate() }
    }

    /// Encloses the exact image of a point.
    pub fn enclosure(&self, p: [f64; 3]) -> [Interval; 3] {
        let (s, t) = self.shrink;
        let p = [0, 1, 2].map(|k| {
            let scaled = p[k] * s * t;
            let exact = scaled == 0.0 && p[k] == 0.0 || scaled.abs() >= f64::MIN_POSITIVE;
            let scaled = if exact { Interval::point(scaled) } else { Interval::around(scaled) };
            if self.origin[k] == 0.0 { scaled } else { scaled - Interval::point(self.origin[k]) }
        });
        self.turn.as_ref().map_or(p, |turn| turn.enclosure(p))
    }

    /// The point whose image is `p`, rounded.
    #[inline]
    pub fn unmap(&self, p: [f64; 3]) -> [f64; 3] {
        let (s, t) = self.grow;
        let p = self.turn.as_ref().map_or(p, |turn| turn.back(p));
        [0, 1, 2].map(|k| (p[k] + self.origin[k]) * s * t)
    }

    /// A length in units of this frame. Exact outside the subnormal range.
    pub fn length_in(&self, length: f64) -> f64 {
        let (s, t) = self.shrink;
        length * s * t
    }

    /// A length of this frame in units of the caller. Exact outside the subnormal range.
    pub fn length_out(&self, length: f64) -> f64 {
        let (s, t) = self.grow;
        length * s * t
    }
}

/// `2^exponent` as a product of two factors.
fn factors(exponent: i32) -> (f64, f64) {
    let half = exponent / 2;
    (power_of_two(half), power_of_two(exponent - half))
}

fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// The least `e` with `x <= 2^e`, for positive finite `x`, subnormal ones included.
fn exponent_above(x: f64) -> i32 {
    let (normal, shift) = if x < f64::MIN_POSITIVE { (x * power_of_two(64), 64) } else { (x, 0) };
    let bits = normal.to_bits();
    let floor = ((bits >> 52) & 0x7ff) as i32 - 1023 - shift;
    if bits & ((1 << 52) - 1) == 0 { floor } else { floor + 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame_of(points: &[[f64; 3]]) -> Frame {
        Frame::of(&Aabb::of_points(points))
    }

    #[test]
    fn maps_any_scale_to_about_one_and_back_without_loss() {
        for scale in [1e-320, 1e-150, 1.0, 3e7, 1e150, 1e300] {
            let points = [[0.0, 0.5 * scale, -scale], [scale, scale, scale]];
            let frame = frame_of(&points);
            for p in points {
                let q = frame.map(p);
                assert!(q.iter().all(|x| x.abs() <= 1.0), "{q:?}");
                assert_eq!(frame.unmap(q), p);
            }
            assert_eq!(frame.length_out(frame.length_in(scale)), scale);
        }
    }

    #[test]
    fn shifts_what_lies_far_away() {
        let points = [[1e9, 1e9, -1e9], [1e9 + 1.0, 1e9 + 0.25, -1e9 + 0.5]];
        let frame = frame_of(&points);
        let (p, q) = (frame.map(points[0]), frame.map(points[1]));
        assert!(p.iter().chain(&q).all(|x| x.abs() <= 1.0));
        assert_eq!([0, 1, 2].map(|k| q[k] - p[k]), [1.0, 0.25, 0.5]);
        assert_eq!(frame.unmap(q), points[1]);
    }

    #[test]
    fn copes_with_a_single_point_and_with_none() {
        assert_eq!(frame_of(&[[0.0; 3]]).map([0.0; 3]), [0.0; 3]);
        assert_eq!(frame_of(&[]), Frame::scaling(0));
        assert!(frame_of(&[[1e-310; 3]]).map([1e-310; 3])[0] <= 1.0);
    }
}
