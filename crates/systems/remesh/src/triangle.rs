//! Normals and shapes of triangles.

use glam::DVec3;

/// Cosine between the normals of a face before and after a step: below it the face counts as turned over.
const LEAST_COSINE: f64 = 0.2;

/// Three corners.
pub(crate) type Triangle = [DVec3; 3];

/// Twice the area of a triangle, along its normal.
pub(super) fn area_vector([a, b, c]: Triangle) -> DVec3 {
    (b - a).cross(c - a)
}

/// Whether a triangle may become another one: neither turned over nor, if it had an area, without one, nor thin.
pub(super) fn keeps_normal(old: Triangle, new: Triangle) -> bool {
    keeps_normal_and_shape(old, new, 1.0)
}

/// The same, but a thin triangle may become thinner down to a share of what it is.
pub(super) fn keeps_normal_and_shape(old: Triangle, new: Triangle, share: f64) -> bool {
    let (n, m) = (area_vector(old), area_vector(new));
    let cosine = n.dot(m);
    n == DVec3::ZERO
        || cosine > 0.0
            && cosine * cosine > LEAST_COSINE * LEAST_COSINE * n.length_squared() * m.length_squared()
            && keeps_shape(new, old, share)
}

/// Height over length below which a triangle is thin.
const THIN: f64 = 0.05;

/// The shape of a thin triangle after the collapse of an edge beside it, at least, as a share of the one before. The collapse of the short edge
/// of a needle makes its neighbours longer by second order: where none may become thinner, a strip of a thousand needles keeps nearly all.
pub(super) const SLIGHTLY_THINNER: f64 = 0.9;

/// The height of a triangle over its longest edge, as a share of that edge; 0 without an edge.
pub(super) fn shape([a, b, c]: Triangle) -> f64 {
    let longest = [(a, b), (b, c), (c, a)].into_iter().fold(0.0, |most: f64, (p, q)| {
        let square = p.distance_squared(q);
        if square > most { square } else { most }
    });
    if longest > 0.0 { area_vector([a, b, c]).length() / longest } else { 0.0 }
}

/// Whether a triangle is not thin, or no thinner than another one.
pub(super) fn is_no_thinner(new: Triangle, old: Triangle) -> bool {
    keeps_shape(new, old, 1.0)
}

/// Whether a triangle is not thin, or its shape is at least a share of that of another one.
fn keeps_shape(new: Triangle, old: Triangle, share: f64) -> bool {
    let found = shape(new);
    found > THIN || found >= share * shape(old)
}
