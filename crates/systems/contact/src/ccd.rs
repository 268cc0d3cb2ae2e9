//! Additive continuous collision detection: a time up to which moving pairs do not touch.
//!
//! # Definition
//! Points move on straight lines `x + t p`, t in [0, 1]. With the mean displacement removed, no two points of a pair approach faster than
//! the sum l of the greatest displacements of its two parts; so `(1 − s) d / l` can be added to t again and again, until the distance
//! is `s` times the first one.
//!
//! # Accuracy
//! The time is never later than the first contact, also as positions are rounded: each step is shorter than the bound by a tenth, and by
//! [`ROUNDING`] of the coordinates for the rounding of distances and of the positions that a step leads to. It may therefore be 0 for pairs that are as
//! close as their coordinates are rounded. Triangles are assumed whose least angle is above 1e-7: thinner ones have distances with fewer digits.
//! # Source
//! `li_codimensional_2021`.

use crate::distance::{Kind, distance_sq};
use glam::DVec3;

/// The part s of the first distance that is left at the time that is returned.
const LEFT: f64 = 0.1;

/// The error of distances and positions, in parts of the greatest coordinate: some 20 roundings of 1.1e-16 each, and their squares.
pub const ROUNDING: f64 = 4e-15;

/// Steps at most; the time reached by then is returned.
const MOST_STEPS: usize = 10_000;

/// A time until which a pair does not touch, none when it does not come close within the whole motion.
pub fn time_of_impact(kind: Kind, x: &[DVec3; 4], p: &[DVec3; 4]) -> Option<f64> {
    time_of_impact_before(kind, x, p, || 1.0)
}

/// The same; none also once the pair is known to be free until a limit, which may fall meanwhile.
///
/// A pair that touches before the limit is followed to its end, so that the least time of many pairs does not depend on their order.
pub(crate) fn time_of_impact_before(
    kind: Kind,
    x: &[DVec3; 4],
    p: &[DVec3; 4],
    limit: impl Fn() -> f64,
) -> Option<f64> {
    let (first, used) = match kind {
        Kind::PointTriangle => (1, 4),
        Kind::EdgeEdge => (2, 4),
        Kind::PointEdge => (1, 3),
        Kind::PointPoint => (1, 2),
    };
    let mean = p[..used].iter().sum::<DVec3>() / used as f64;
    let mut moved = *p;
    for p in &mut moved[..used] {
        *p -= mean;
    }
    let greatest = |part: &[DVec3]| part.iter().map(|p| p.length_squared()).fold(0.0, f64::max).sqrt();
    let speed = greatest(&moved[..first]) + greatest(&moved[first..used]);
    let start = distance_sq(kind, x).sqrt();
    let reach = x[..used].iter().zip(p).map(|(x, p)| (x.abs() + p.abs()).max_element()).fold(0.0, f64::max);
    let rounding = ROUNDING * reach;
    let free = |distance: f64| (1.0 - LEFT) * (distance - rounding) / speed;
    if speed <= 0.0 || start - rounding > speed {
        return None;
    }
    let least = LEFT * start;
    let (mut time, mut step) = (0.0, free(start));
    // Whatever time is found is not before the end of the first step.
    if step >= limit() {
        return None;
    }
    for _ in 0..MOST_STEPS {
        if step <= 0.0 {
            return Some(time);
        }
        let next = time + step;
        if next >= 1.0 {
            return None;
        }
        let at: [DVec3; 4] = std::array::from_fn(|i| x[i] + moved[i] * next);
        let distance = distance_sq(kind, &at).sqrt();
        if distance < least {
            return Some(if time > 0.0 { time } else { step });
        }
        time = next;
        if time >= limit() {
            return None;
        }
        step = free(distance);
    }
    Some(time)
}
