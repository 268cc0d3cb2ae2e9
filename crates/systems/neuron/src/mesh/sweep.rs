//! Frames and sections along a tube.

use super::tube::Tube;
use glam::DVec3;

/// A section of a tube.
#[derive(Clone, Copy)]
pub(super) struct Station {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
    /// Unit vectors across the tube; right-handed together with its direction.
    pub(super) sides: [DVec3; 2],
}

impl Station {
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> DVec3 {
        self.centre + (self.sides[0] * x + self.sides[1] * y) * self.radius
    }
}

/// Integration steps per radius for lengths in radii.
const STEPS: f64 = 4.0;

/// Largest number of steps along one tube.
const MOST: f64 = 4e6;

/// Lengths along a tube in units of its radius.
pub(super) struct RadialLength {
    at: Vec<f64>,
    sum: Vec<f64>,
}

impl RadialLength {
    pub(super) fn new(tube: &Tube, from: f64, to: f64) -> Self {
        let (mut at, mut sum) = (vec![from], vec![0.0]);
        let least = (to - from) / MOST;
        let (mut s, mut total) = (from, 0.0);
        while s < to {
            let step = (tube.at(s).1 / STEPS).max(least);
            let next = if s + 1.5 * step >= to { to } else { s + step };
            total += (next - s) / tube.at(0.5 * (s + next)).1;
            s = next;
            at.push(s);
            sum.push(total);
        }
        Self { at, sum }
    }

    pub(super) fn total(&self) -> f64 {
        self.sum[self.sum.len() - 1]
    }

    /// The length along the tube at a share of the total.
    fn share(&self, share: f64) -> f64 {
        let wanted = share * self.total();
        let k = self.sum.partition_point(|&x| x < wanted).clamp(1, self.sum.len() - 1);
        let (low, high) = (self.sum[k - 1], self.sum[k]);
        let within = if high > low { ((wanted - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        self.at[k - 1] + (self.at[k] - self.at[k - 1]) * within
    }
}

/// Sections at equal lengths in radii; the first side may be given.
///
/// # Source
/// Rotation-minimising frames: double reflection, `wang_frames_2008`.
pub(super) fn stations(
    tube: &Tube,
    lengths: &RadialLength,
    count: usize,
    side: Option<DVec3>,
) -> Vec<Station> {
    let mut found: Vec<Station> = Vec::with_capacity(count + 1);
    let mut last: Option<(DVec3, DVec3, DVec3)> = None;
    for k in 0..=count {
        let s = lengths.share(k as f64 / count as f64);
        let (centre, radius) = tube.at(s);
        let tangent = tube.tangent(s);
        let first = match last {
            None => {
                let any = side.unwrap_or_else(|| tangent.any_orthonormal_vector());
                (any - tangent * any.dot(tangent)).normalize_or(tangent.any_orthonormal_vector())
            }
            Some((from, direction, side)) => {
                let reflect = |v: DVec3, n: DVec3| {
                    let square = n.length_squared();
                    if square > 0.0 { v - n * (2.0 * v.dot(n) / square) } else { v }
                };
                let step = centre - from;
                let (side, direction) = (reflect(side, step), reflect(direction, step));
                let turned = reflect(side, tangent - direction);
                (turned - tangent * turned.dot(tangent)).normalize_or(tangent.any_orthonormal_vector())
            }
        };
        last = Some((centre, tangent, first));
        found.push(Station { centre, radius, sides: [first, tangent.cross(first)] });
    }
    found
}

/// Twists the sections evenly so that the last one meets given corners. Returns the corner that the first corner of the tube meets,
/// and the angle in radians.
pub(super) fn twist(stations: &mut [Station], corners: [DVec3; 4]) -> (usize, f64) {
    let last = stations[stations.len() - 1];
    let off = |corner: DVec3| {
        let angle =
            libm::atan2(corner.dot(last.sides[1]), corner.dot(last.sides[0])) - std::f64::consts::FRAC_PI_4;
        angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
    };
    let offs = corners.map(off);
    let best = (0..4).fold(0, |best, k| if offs[k].abs() < offs[best].abs() { k } else { best });
    let count = (stations.len() - 1) as f64;
    for (k, station) in stations.iter_mut().enumerate() {
        let angle = offs[best] * k as f64 / count;
        let ([a, b], (sine, cosine)) = (station.sides, (libm::sin(angle), libm::cos(angle)));
        station.sides = [a * cosine + b * sine, b * cosine - a * sine];
    }
    (best, offs[best])
}
