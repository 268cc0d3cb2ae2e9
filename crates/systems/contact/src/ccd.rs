//! Additive continuous collision detection: a time up to which moving pairs do not touch.
//!
//! # Definition
//! Points move on straight lines `x + t p`, t in [0, 1]. With the mean displacement removed, no two points of a pair approach faster than
//! the sum l of the greatest displacements of its two parts; so `(1 − s) d / l` can be added to t again and again, until the distance
//! is `s` times the first one.
//!
//! # Accuracy
//! The time is never later than the first contact: each step is shorter than the bound by a part of it that is far above rounding.
//! # Source
//! `li_codimensional_2021`.

use crate::distance::{Closest, Kind};
use glam::DVec3;

/// The part s of the first distance that is left at the time that is returned.
const LEFT: f64 = 0.1;

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
    let greatest = |part: &[DVec3]| part.iter().map(|p| p.length()).fold(0.0, f64::max);
    let speed = greatest(&moved[..first]) + greatest(&moved[first..used]);
    let start = Closest::of(kind, x).distance_sq().sqrt();
    if speed <= 0.0 || start > speed {
        return None;
    }
    let least = LEFT * start;
    let (mut time, mut step) = (0.0, (1.0 - LEFT) * start / speed);
    for _ in 0..MOST_STEPS {
        let next = time + step;
        if next >= 1.0 {
            return None;
        }
        let at: [DVec3; 4] = std::array::from_fn(|i| x[i] + moved[i] * next);
        let distance = Closest::of(kind, &at).distance_sq().sqrt();
        if distance < least {
            return Some(if time > 0.0 { time } else { step });
        }
        time = next;
        if time >= limit() {
            return None;
        }
        step = (1.0 - LEFT) * distance / speed;
    }
    Some(time)
}
