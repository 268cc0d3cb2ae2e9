//! Frames and sections along a tube.

use super::tube::{Mitre, Tube};
use glam::DVec3;

/// A section of a tube.
#[derive(Clone, Copy)]
pub(super) struct Station {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
    /// Unit vectors across the tube; right-handed together with its direction. In a slanted section, their images in its plane.
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
    /// The lengths so far at the ends and at corners of the tube.
    ends: Vec<f64>,
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
        let mut lengths = Self { at, sum, ends: vec![0.0] };
        let corners: Vec<f64> = tube.stops(from, to).into_iter().map(|s| lengths.up_to(s)).collect();
        lengths.ends.extend(corners);
        lengths.ends.push(total);
        lengths
    }

    /// The length in radii up to a length along the tube.
    fn up_to(&self, s: f64) -> f64 {
        let k = self.at.partition_point(|&x| x < s).clamp(1, self.at.len() - 1);
        let share = (s - self.at[k - 1]) / (self.at[k] - self.at[k - 1]);
        self.sum[k - 1] + share * (self.sum[k] - self.sum[k - 1])
    }

    /// Blocks of at most `layer` radii between one end or corner and the next.
    fn blocks(&self, layer: f64) -> impl Iterator<Item = usize> {
        self.ends.windows(2).map(move |ends| ((ends[1] - ends[0]) / layer).ceil().max(1.0) as usize)
    }

    /// Blocks of at most `layer` radii along the tube.
    pub(super) fn blocks_along(&self, layer: f64) -> usize {
        self.blocks(layer).sum()
    }

    /// Lengths along the tube at which sections lie: the ends of blocks, and `parts` in each block.
    pub(super) fn places(&self, layer: f64, parts: usize) -> Vec<f64> {
        let mut found = vec![self.share(0.0)];
        for (ends, blocks) in self.ends.windows(2).zip(self.blocks(layer)) {
            let count = blocks * parts;
            let wanted = |k: usize| ends[0] + (k as f64 / count as f64) * (ends[1] - ends[0]);
            found.extend((1..=count).map(|k| self.share(wanted(k))));
        }
        found
    }

    /// The length along the tube up to which there are so many radii.
    fn share(&self, wanted: f64) -> f64 {
        let k = self.sum.partition_point(|&x| x < wanted).clamp(1, self.sum.len() - 1);
        let (low, high) = (self.sum[k - 1], self.sum[k]);
        let within = if high > low { ((wanted - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        self.at[k - 1] + (self.at[k] - self.at[k - 1]) * within
    }
}

/// Sections at lengths along a tube; the first side may be given.
///
/// # Source
/// Rotation-minimising frames: double reflection, `wang_frames_2008`.
pub(super) fn stations(tube: &Tube, places: &[f64], side: Option<DVec3>) -> Vec<Station> {
    let mitres = match (places.first(), places.last()) {
        (Some(from), Some(to)) => tube.mitres(*from, *to),
        _ => Vec::new(),
    };
    if !mitres.is_empty() {
        return mitred(tube, places, &mitres, side);
    }
    let mut found: Vec<Station> = Vec::with_capacity(places.len());
    let mut last: Option<(DVec3, DVec3, DVec3)> = None;
    for &s in places {
        let (centre, radius) = tube.section(s);
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

/// Sections of a tube with corners: across it at its ends, in the bisecting plane at corners, linear in between.
fn mitred(tube: &Tube, places: &[f64], mitres: &[Mitre], side: Option<DVec3>) -> Vec<Station> {
    let (from, to) = (places[0], places[places.len() - 1]);
    let mut direction = mitres[0].directions[0];
    let any = side.unwrap_or_else(|| direction.any_orthonormal_vector());
    let mut first = (any - direction * any.dot(direction)).normalize_or(direction.any_orthonormal_vector());
    let section = |s: f64, sides: [DVec3; 2]| {
        let (centre, radius) = tube.section(s);
        (s, Station { centre, radius: 1.0, sides: sides.map(|side| side * radius) })
    };
    let mut keys = vec![section(from, [first, direction.cross(first)])];
    let mut kinks = tube.kinks(from, to).into_iter().peekable();
    for mitre in mitres {
        while let Some(kink) = kinks.next_if(|kink| *kink < mitre.at) {
            keys.push(section(kink, [first, direction.cross(first)]));
        }
        let [before, after] = mitre.directions;
        let plane = before + after;
        // Along the tube onto the plane.
        let slanted = |v: DVec3| v - before * (v.dot(plane) / before.dot(plane));
        // Away from the inside of the turn, across the segments before and after it.
        let cosine = before.dot(after);
        let outwards = [before * cosine - after, before - after * cosine].map(DVec3::normalize_or_zero);
        let slope = mitre.slant() / tube.at(mitre.at).1;
        if mitre.is_shared() {
            let tilted = |v: DVec3| v + before * (v.dot(outwards[0]) * slope);
            keys.push(section(mitre.at - mitre.slant(), [first, before.cross(first)].map(tilted)));
        }
        keys.push(clipped(
            section(mitre.at, [first, before.cross(first)].map(slanted)),
            mitre,
            slanted(outwards[0]),
        ));
        // The points of the slanted section, along the next segment onto a plane across it.
        let next = slanted(first);
        first = (next - after * next.dot(after)).normalize_or(after.any_orthonormal_vector());
        direction = after;
        if mitre.is_shared() {
            let tilted = |v: DVec3| v - after * (v.dot(outwards[1]) * slope);
            keys.push(section(mitre.at + mitre.slant(), [first, after.cross(first)].map(tilted)));
        }
    }
    keys.extend(kinks.chain([to]).map(|s| section(s, [first, direction.cross(first)])));
    let at = |&s: &f64| {
        let k = keys.partition_point(|(key, _)| *key <= s).clamp(1, keys.len() - 1);
        let ((a, low), (b, high)) = (&keys[k - 1], &keys[k]);
        let t = ((s - a) / (b - a)).clamp(0.0, 1.0);
        Station {
            centre: low.centre.lerp(high.centre, t),
            radius: 1.0,
            sides: [0, 1].map(|k| low.sides[k].lerp(high.sides[k], t)),
        }
    };
    places.iter().map(at).collect()
}

/// The section in a bisecting plane with its half axes inwards and outwards; `outwards` is that of the cylinder.
fn clipped((s, station): (f64, Station), mitre: &Mitre, outwards: DVec3) -> (f64, Station) {
    let [inner, outer] = mitre.half_axes();
    let unit = outwards.normalize_or_zero();
    let share = 0.5 * (inner + outer) / inner;
    let sides = station.sides.map(|side| side + unit * (side.dot(unit) * (share - 1.0)));
    // In micrometres, as the sides are; the half axis of the cylinder is the inner one.
    let radius = station.sides.map(|side| side.dot(unit)).iter().map(|x| x * x).sum::<f64>().sqrt() / inner;
    let centre = station.centre + unit * (0.5 * (outer - inner) * radius);
    (s, Station { centre, sides, ..station })
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
