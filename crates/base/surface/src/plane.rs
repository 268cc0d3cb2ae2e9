//! Vectors in the plane, for the frames of faces.

/// A vector or point of the plane.
pub type Vec2 = [f64; 2];

/// `a + b`.
#[inline]
pub fn add(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] + b[0], a[1] + b[1]]
}

/// `a − b`.
#[inline]
pub fn sub(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// `s a`.
#[inline]
pub fn scale(s: f64, a: Vec2) -> Vec2 {
    [s * a[0], s * a[1]]
}

/// `a · b`.
#[inline]
pub fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The determinant of two vectors: above zero if `b` is counter-clockwise from `a`.
#[inline]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A quarter turn counter-clockwise.
#[inline]
pub fn quarter_turn(a: Vec2) -> Vec2 {
    [-a[1], a[0]]
}

/// The length of a vector.
#[inline]
pub fn norm(a: Vec2) -> f64 {
    dot(a, a).sqrt()
}

/// A rotation as a unit complex number, `[cos, sin]`.
pub type Rotation = [f64; 2];

/// A vector rotated; also the composition of two rotations.
#[inline]
pub fn rotate(rotation: Rotation, a: Vec2) -> Vec2 {
    [rotation[0] * a[0] - rotation[1] * a[1], rotation[1] * a[0] + rotation[0] * a[1]]
}

/// The inverse rotation.
#[inline]
pub fn inverse(rotation: Rotation) -> Rotation {
    [rotation[0], -rotation[1]]
}
