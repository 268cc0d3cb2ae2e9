//! Exact tests whether a map is one-to-one, on the coordinates as stored.

mod orientation;
mod outline;
mod overlap;

pub(crate) use orientation::flipped_faces;
pub(crate) use outline::{outline, outline_crossings};
pub(crate) use overlap::overlapping_faces;

use pompeiu_surface::plane::Vec2;
use robust::{Coord, orient2d};

/// The orientation of three points: positive if they are counter-clockwise, zero if they are collinear.
///
/// # Accuracy
/// The sign is exact where no product of differences of coordinates underflows or overflows: always for multiples of
/// 2^-500 below 2^500.
/// # Source
/// `shewchuk_predicates_1997`, through the crate `robust`.
pub(crate) fn orientation(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}
