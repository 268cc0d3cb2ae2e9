//! Poses of copies of a shape.

use super::map::Map;
use pompeiu_planar::{Outline, OutlineError, Point};

/// The pose of a copy of the shape: optional reflection, then rotation, then translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The position of its centroid.
    pub place: Point,
    /// The rotation in radians.
    pub angle: f64,
    /// Whether the first coordinate is negated before that.
    pub is_mirrored: bool,
}

impl Pose {
    pub(super) fn turn(&self) -> Turned {
        let (sine, cosine) = libm::sincos(self.angle);
        Turned { place: self.place, cosine, sine, hand: if self.is_mirrored { -1.0 } else { 1.0 } }
    }

    /// The shape in this pose, scaled.
    pub(crate) fn apply(&self, shape: &Outline, scale: f64) -> Result<Outline, OutlineError> {
        let turned = self.turn();
        shape.map(|p| turned.to_place(p.map(|x| scale * x)))
    }
}

/// A pose with its sine and cosine.
#[derive(Clone, Copy)]
pub(super) struct Turned {
    pub(super) place: Point,
    pub(super) cosine: f64,
    pub(super) sine: f64,
    pub(super) hand: f64,
}

impl Turned {
    /// The point of the shape that lies at p.
    #[inline]
    pub(super) fn to_shape(self, p: Point) -> Point {
        let [x, y] = self.turned_back(p);
        [self.hand * x, y]
    }

    #[inline]
    fn turned_back(self, p: Point) -> Point {
        let [x, y] = [p[0] - self.place[0], p[1] - self.place[1]];
        [self.cosine * x + self.sine * y, self.cosine * y - self.sine * x]
    }

    pub(super) fn to_place(self, [x, y]: Point) -> Point {
        let x = self.hand * x;
        [self.place[0] + self.cosine * x - self.sine * y, self.place[1] + self.sine * x + self.cosine * y]
    }

    /// Rotates and reflects a vector of the shape.
    #[inline]
    pub(super) fn vector(self, [x, y]: Point) -> Point {
        let x = self.hand * x;
        [self.cosine * x - self.sine * y, self.sine * x + self.cosine * y]
    }

    /// The value of a map at p, with its derivatives with respect to position and angle.
    pub(super) fn with_gradient(self, map: &Map, p: Point) -> (f64, [f64; 3]) {
        let [x, y] = self.turned_back(p);
        let (value, g) = map.with_gradient([self.hand * x, y]);
        let [u, v] = self.vector(g);
        (value, [-u, -v, g[0] * self.hand * y - g[1] * x])
    }
}
