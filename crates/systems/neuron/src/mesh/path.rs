//! Paths of balls: how far a spline through them is from them, and where they turn.

use crate::RoundCone;
use crate::curve::Curve;
use glam::DVec3;

/// Largest share of a segment that the sections at its ends may take.
pub(super) const ROOM: f64 = 0.9;

/// Largest turn, in degrees, at which the section lies in the bisecting plane: beyond it cells are too slanted.
const MOST_MITRE: f64 = 125.0;

/// Angle in degrees from which on slanted sections before and after a mitre share the turn.
const SHARED_FROM: f64 = 42.0;

/// Distance of a slanted section from the mitre on the inside of the turn, in radii.
pub(super) const GAP: f64 = 0.5;

/// Largest share of the next segment that the sections of a shared turn may take.
const SHARED_ROOM: f64 = 0.45;

/// Largest turn, in degrees, of a mitre that does not share it: from there on the wall is farther from the ball than is tolerated.
const MOST_ALONE: f64 = 80.0;

/// Whether slanted sections before and after a mitre share the turn: from the angle's cosine, and the length of the shorter segment in radii.
pub(super) fn is_shared(cosine: f64, room: f64) -> bool {
    cosine < libm::cos(SHARED_FROM.to_radians()) && half_tangent(cosine) + GAP <= SHARED_ROOM * room
}

/// Whether the wall of a mitre is too far from the ball, because slanted sections that would share the turn have no room.
pub(super) fn is_alone(cosine: f64, room: f64) -> bool {
    cosine < libm::cos(MOST_ALONE.to_radians()) && !is_shared(cosine, room)
}

/// The tangent of half the angle by which a path turns, from the angle's cosine: half the extent of a section in the bisecting plane along the path, over
/// the radius.
pub(super) fn half_tangent(cosine: f64) -> f64 {
    ((1.0 - cosine) / (1.0 + cosine).max(f64::MIN_POSITIVE)).max(0.0).sqrt()
}

/// Whether a path turns too sharply for a section in the bisecting plane, from the angle's cosine.
pub(super) fn is_beyond_mitres(cosine: f64) -> bool {
    cosine < libm::cos(MOST_MITRE.to_radians())
}

/// Steps per span of a spline whose distance from the samples is computed.
const STEPS_PER_SPAN: usize = 8;

/// The larger one of the two distances, over the radius, from the spline of points to the polyline through samples and back.
pub(super) fn deviation(points: &[(DVec3, f64)], samples: &[(DVec3, f64)]) -> f64 {
    let curve = Curve::new(points.iter().copied());
    let steps = STEPS_PER_SPAN * curve.end() as usize;
    let on_curve: Vec<(DVec3, f64)> =
        (0..=steps).map(|k| curve.at(curve.end() * k as f64 / steps as f64)).collect();
    farthest(&on_curve, samples).max(farthest(samples, &on_curve))
}

/// The greatest distance of points from a path, over their radii. Points and path run the same way, so that the segments near the same
/// share of the whole suffice.
fn farthest(points: &[(DVec3, f64)], path: &[(DVec3, f64)]) -> f64 {
    let spans = path.len() - 1;
    let around = (spans / 8).max(4 * STEPS_PER_SPAN);
    let distance = |(i, (p, radius)): (usize, &(DVec3, f64))| {
        let middle = i * spans / points.len();
        let near = middle.saturating_sub(around)..(middle + around).min(spans);
        let axis = |k: usize| RoundCone { ends: [path[k].0, path[k + 1].0], radii: [0.0; 2] };
        near.map(|k| axis(k).distance(*p).0).fold(f64::INFINITY, f64::min) / radius
    };
    points.iter().enumerate().map(distance).fold(0.0, f64::max)
}

/// Largest distance of a sample from the segment past it, and of its radius from that there, over its radius.
const ON_SEGMENT: f64 = 0.02;

/// The samples at which a polyline turns or its radius changes: sections at the others would only take room from these.
pub(super) fn thinned(points: &[(DVec3, f64)]) -> Vec<usize> {
    let mut kept = vec![false; points.len()];
    (kept[0], kept[points.len() - 1]) = (true, true);
    let mut parts = vec![(0, points.len() - 1)];
    while let Some((from, to)) = parts.pop() {
        let [a, b] = [points[from], points[to]];
        let way = b.0 - a.0;
        let off = |k: usize| {
            let (p, radius) = points[k];
            let square = way.length_squared();
            let share = if square > 0.0 { ((p - a.0).dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
            (p.distance(a.0 + way * share)).max((radius - a.1 - (b.1 - a.1) * share).abs()) / radius
        };
        let farthest = (from + 1..to).map(|k| (off(k), k)).max_by(|x, y| x.0.total_cmp(&y.0));
        if let Some((_, k)) = farthest.filter(|(most, _)| *most > ON_SEGMENT) {
            kept[k] = true;
            parts.extend([(from, k), (k, to)]);
        }
    }
    (0..points.len()).filter(|k| kept[*k]).collect()
}

/// Largest number of smoothing steps.
const MOST_STEPS: usize = 60;

/// Largest product of curvature and radius after smoothing.
const MOST_BEND: f64 = 0.6;

/// Moves control points halfway to the mean of their neighbours where the curve bends too much for its radius.
pub(super) fn relax(points: &mut [(DVec3, f64)]) {
    for _ in 0..MOST_STEPS {
        let bent: Vec<usize> = (1..points.len().saturating_sub(1))
            .filter(|&k| {
                let (a, b, c) = (points[k - 1].0, points[k].0, points[k + 1].0);
                let area = (b - a).cross(c - b).length();
                let sides = a.distance(b) * b.distance(c) * a.distance(c);
                // The circle through three points; the spline bends less.
                2.0 * area * points[k].1 > MOST_BEND * sides || (b - a).dot(c - b) < 0.0
            })
            .collect();
        if bent.is_empty() {
            return;
        }
        let before = points.to_vec();
        for k in bent {
            points[k].0 = 0.5 * before[k].0 + 0.25 * (before[k - 1].0 + before[k + 1].0);
        }
    }
}
