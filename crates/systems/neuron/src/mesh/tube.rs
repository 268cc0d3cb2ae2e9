//! Tubes: the parts of branches between two nodes.

use crate::curve::{ArcLength, Curve};
use crate::{RoundCone, SOMA, Skeleton, Soma};
use glam::DVec3;

/// Chords per span for the length of a curve.
const PER_SPAN: usize = 24;

/// A branch with a smooth axis, divided into round cones.
pub(super) struct Tube {
    /// The samples at its ends.
    pub(super) nodes: [usize; 2],
    curve: Curve,
    lengths: ArcLength,
    /// Round cones along it, and the lengths at which they begin; one more length than cones.
    pub(super) cones: Vec<RoundCone>,
    pub(super) starts: Vec<f64>,
}

impl Tube {
    fn new(nodes: [usize; 2], points: Vec<(DVec3, f64)>) -> Self {
        let curve = Curve::new(points);
        let lengths = curve.arc_length(PER_SPAN);
        let total = lengths.total();
        let mut tube = Self { nodes, curve, lengths, cones: Vec::new(), starts: vec![0.0] };
        let mut s = 0.0;
        let mut last = tube.at(0.0);
        while s < total {
            // Half a radius, but at least a fraction of the whole.
            let step = (0.5 * last.1).max(total / MOST_CONES);
            s = if s + 1.5 * step >= total { total } else { s + step };
            let next = tube.at(s);
            tube.cones.push(RoundCone { ends: [last.0, next.0], radii: [last.1, next.1] });
            tube.starts.push(s);
            last = next;
        }
        tube
    }

    pub(super) fn length(&self) -> f64 {
        self.lengths.total()
    }

    /// Position and radius at a length along the tube.
    pub(super) fn at(&self, s: f64) -> (DVec3, f64) {
        self.curve.at(self.lengths.parameter(s))
    }

    /// Direction along the tube.
    pub(super) fn tangent(&self, s: f64) -> DVec3 {
        let t = self.lengths.parameter(s);
        let direct = self.curve.derivative(t).normalize_or_zero();
        if direct != DVec3::ZERO {
            return direct;
        }
        let h = 1e-3 * self.length();
        let (a, b) = (self.at((s - h).max(0.0)).0, self.at((s + h).min(self.length())).0);
        (b - a).normalize_or(DVec3::X)
    }
}

/// Largest number of cones of a tube.
const MOST_CONES: f64 = 20_000.0;

/// A tube as seen from a node at one of its ends.
#[derive(Clone, Copy)]
pub(super) struct End {
    pub(super) tube: usize,
    /// Whether the node is at the tube's first end.
    pub(super) first: bool,
}

impl End {
    pub(super) fn at(self, tubes: &[Tube], s: f64) -> (DVec3, f64) {
        let tube = &tubes[self.tube];
        tube.at(if self.first { s } else { tube.length() - s })
    }

    pub(super) fn tangent(self, tubes: &[Tube], s: f64) -> DVec3 {
        let tube = &tubes[self.tube];
        if self.first { tube.tangent(s) } else { -tube.tangent(tube.length() - s) }
    }

    /// The cones within a length of the node.
    pub(super) fn cones(self, tubes: &[Tube], within: f64) -> &[RoundCone] {
        let tube = &tubes[self.tube];
        if self.first {
            let count = tube.starts.partition_point(|&s| s < within).min(tube.cones.len());
            &tube.cones[..count]
        } else {
            let from = tube.length() - within;
            let skip = tube.starts[1..].partition_point(|&s| s <= from).min(tube.cones.len());
            &tube.cones[skip..]
        }
    }
}

/// A ball is a soma if its radius is at least this multiple of its neighbour's.
const SOMA_FACTOR: f64 = 1.5;

/// Whether a sample is a ball whose tubes start with radii of their own.
pub(super) fn is_ball(skeleton: &Skeleton, sample: usize) -> bool {
    let samples = skeleton.samples();
    let neighbours = skeleton.children(sample).iter().copied().chain(skeleton.parent(sample));
    let widest = neighbours.map(|i| samples[i].radius).fold(0.0, f64::max);
    matches!(skeleton.soma(), Soma::Point | Soma::ThreePoints)
        && samples[sample].kind == SOMA
        && widest > 0.0
        && samples[sample].radius > SOMA_FACTOR * widest
}

/// The tubes between nodes. Nodes are balls, and samples with one neighbour or more than two.
///
/// Radii are multiplied by a factor. Axes that bend too much for their radius are smoothed.
pub(super) fn tubes(skeleton: &Skeleton, factor: f64) -> Vec<Tube> {
    let samples = skeleton.samples();
    let mut paths = skeleton.branches();
    // A root with two neighbours is a node only if it is a ball.
    for root in skeleton.roots().filter(|&root| skeleton.degree(root) == 2 && !is_ball(skeleton, root)) {
        let at = |paths: &[Vec<usize>]| paths.iter().position(|path| path[0] == root);
        if let Some(first) = at(&paths) {
            let second = paths.remove(first);
            if let Some(other) = at(&paths) {
                let joined = second.into_iter().rev().chain(paths[other][1..].iter().copied()).collect();
                paths[other] = joined;
            }
        }
    }
    paths
        .into_iter()
        .map(|path| {
            let last = path.len() - 1;
            let mut points: Vec<(DVec3, f64)> =
                path.iter().map(|&i| (samples[i].position, factor * samples[i].radius)).collect();
            if is_ball(skeleton, path[0]) {
                points[0].1 = points[1.min(last)].1;
            }
            if is_ball(skeleton, path[last]) {
                points[last].1 = points[last.saturating_sub(1)].1;
            }
            points.dedup_by(|b, a| a.0 == b.0);
            if points.len() < 2 {
                points.push(points[0]);
            }
            relax(&mut points);
            Tube::new([path[0], path[last]], points)
        })
        .collect()
}

/// Largest number of smoothing steps.
const MOST_STEPS: usize = 60;

/// Largest product of curvature and radius after smoothing.
const MOST_BEND: f64 = 0.6;

/// Moves control points halfway to the mean of their neighbours where the curve bends too much for its radius.
fn relax(points: &mut [(DVec3, f64)]) {
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
