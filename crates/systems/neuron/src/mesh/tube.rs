//! Tubes: the parts of branches between two nodes.

use super::folds::{Division, divided};
use super::path::{GAP, ROOM, deviation, half_tangent, is_beyond_mitres, is_shared, relax, thinned};
use super::profile::Profile;
use crate::curve::{ArcLength, Curve};
use crate::{RoundCone, SOMA, Skeleton, Soma};
use glam::DVec3;

/// Chords per span for the length of a curve.
const PER_SPAN: usize = 24;

/// A branch, divided into round cones.
pub(super) struct Tube {
    /// The samples along it.
    pub(super) samples: Vec<usize>,
    /// The samples at its ends.
    pub(super) nodes: [usize; 2],
    /// The branch that it is a part of.
    pub(super) branch: usize,
    axis: Axis,
    profile: Profile,
    /// The lengths at which its radius changes fast.
    kinks: Vec<f64>,
    /// Round cones along it, and the lengths at which they begin; one more length than cones.
    pub(super) cones: Vec<RoundCone>,
    pub(super) starts: Vec<f64>,
    /// The greatest distance of the axis from the samples, over the radius, where it is more than the tolerance; otherwise 0.
    pub(super) moved: f64,
}

/// The axis of a tube.
enum Axis {
    /// A spline whose control points are the samples, with the lengths of the polyline up to them in the place of radii.
    Smooth { curve: Curve, lengths: ArcLength },
    /// The polyline through the samples, and the lengths up to each of them.
    Straight { points: Vec<(DVec3, f64)>, lengths: Vec<f64> },
}

/// A sample at which a tube turns. The section there lies in the plane that bisects the angle.
#[derive(Clone, Copy)]
pub(super) struct Mitre {
    /// Length along the tube.
    pub(super) at: f64,
    /// Directions before and after.
    pub(super) directions: [DVec3; 2],
    /// Tangent of half the angle.
    tangent: f64,
    radius: f64,
    /// Whether slanted sections before and after it share the turn, so that the wall follows the ball on the outside.
    is_shared: bool,
}

/// Distance of the corners of a polygonal section outside of the circle, and of its sides inside, over the radius.
const POLYGON: [f64; 2] = [0.054, 0.026];

/// By how much a mitre of a shared turn is beyond the ball, over `1 − cos θ/2`: its neighbours' chords are inside.
const SHARED_EXCESS: f64 = 0.18;

/// Distance of the corners of a section from the ball up to which it is that of the cylinder, in radii.
const PLAIN: f64 = 0.13;

impl Mitre {
    /// Half the extent of slanted sections along the axis.
    pub(super) fn slant(&self) -> f64 {
        0.5 * (self.tangent + GAP) * self.radius
    }

    /// The lengths along the tube at which there are sections: the mitre, and slanted sections before and after it.
    pub(super) fn places(&self) -> Vec<f64> {
        if self.is_shared {
            vec![self.at - self.slant(), self.at, self.at + self.slant()]
        } else {
            vec![self.at]
        }
    }

    /// Whether slanted sections share the turn.
    pub(super) fn is_shared(&self) -> bool {
        self.is_shared
    }

    /// Half axes of the section in the plane of the turn over the radius: inwards, where both sides of the tube meet, and outwards,
    /// between the section of the cylinder, which leaves the ball, and the ball, of which the sides fall short.
    pub(super) fn half_axes(&self) -> [f64; 2] {
        let cosine = 1.0 / (1.0 + self.tangent * self.tangent).sqrt();
        let [corners, sides] = POLYGON;
        if (1.0 + corners) / cosine - 1.0 <= PLAIN {
            return [1.0 / cosine; 2];
        }
        let outwards = if self.is_shared {
            1.0 + SHARED_EXCESS * (1.0 - cosine)
        } else {
            2.0 / (1.0 + corners + (1.0 - sides) * cosine)
        };
        [1.0 / cosine, outwards.clamp(1.0, 1.0 / cosine)]
    }

    /// The length along the tube that its sections take on each side.
    fn reach(&self) -> f64 {
        if self.is_shared { 2.0 * self.slant() } else { self.radius * self.tangent }
    }
}

impl Tube {
    fn smooth(samples: Vec<usize>, points: &[(DVec3, f64)], factor: f64, moved: f64) -> Self {
        let along = lengths_along(points);
        let curve = Curve::new(points.iter().zip(&along).map(|((p, _), l)| (*p, *l)));
        let profile = Profile::new(along.into_iter().zip(points.iter().map(|(_, r)| *r)).collect(), factor);
        let lengths = curve.arc_length(PER_SPAN);
        let total = lengths.total();
        let axis = Axis::Smooth { curve, lengths };
        let nodes = ends(&samples);
        let (kinks, cones, starts) = (Vec::new(), Vec::new(), vec![0.0]);
        let mut tube = Self { samples, nodes, branch: 0, axis, profile, kinks, cones, starts, moved };
        tube.kinks = tube.profile.kinks().into_iter().map(|l| tube.place(l)).collect();
        let corners: Vec<f64> = tube.profile.corners().into_iter().map(|l| tube.place(l)).collect();
        let mut corners = corners.into_iter().peekable();
        let mut s = 0.0;
        let mut last = tube.at(0.0);
        while s < total {
            // Half a radius, but at least a fraction of the whole.
            let step = (0.5 * last.1).max(total / MOST_CONES);
            while corners.next_if(|corner| *corner <= s).is_some() {}
            let end = corners.peek().copied().unwrap_or(total).min(total);
            s = if s + 1.5 * step >= end { end } else { s + step };
            let next = tube.at(s);
            tube.cones.push(RoundCone { ends: [last.0, next.0], radii: [last.1, next.1] });
            tube.starts.push(s);
            last = next;
        }
        tube
    }

    fn straight(samples: Vec<usize>, points: Vec<(DVec3, f64)>, factor: f64) -> Self {
        let lengths = lengths_along(&points);
        let cone = |pair: &[(DVec3, f64)]| {
            let [a, b] = [pair[0], pair[1]];
            RoundCone { ends: [a.0, b.0], radii: [a.1, b.1] }
        };
        let cones = points.windows(2).map(cone).collect();
        let starts = lengths.clone();
        let nodes = ends(&samples);
        let profile = lengths.iter().copied().zip(points.iter().map(|(_, r)| *r)).collect();
        let profile = Profile::new(profile, factor);
        let axis = Axis::Straight { points, lengths };
        let kinks = profile.kinks();
        Self { samples, nodes, branch: 0, axis, profile, kinks, cones, starts, moved: 0.0 }
    }

    pub(super) fn length(&self) -> f64 {
        match &self.axis {
            Axis::Smooth { lengths, .. } => lengths.total(),
            Axis::Straight { lengths, .. } => lengths[lengths.len() - 1],
        }
    }

    /// Position and radius of the ball at a length along the tube.
    pub(super) fn at(&self, s: f64) -> (DVec3, f64) {
        match &self.axis {
            Axis::Smooth { curve, lengths } => {
                let (p, l) = curve.at(lengths.parameter(s));
                (p, self.profile.ball(l))
            }
            Axis::Straight { points, lengths } => {
                let k = segment(lengths, s);
                let t = ((s - lengths[k]) / (lengths[k + 1] - lengths[k])).clamp(0.0, 1.0);
                let (a, b) = (points[k], points[k + 1]);
                (a.0.lerp(b.0, t), a.1 + (b.1 - a.1) * t)
            }
        }
    }

    /// The length of the polyline through the samples up to a length along the tube.
    fn along(&self, s: f64) -> f64 {
        match &self.axis {
            Axis::Smooth { curve, lengths } => curve.at(lengths.parameter(s)).1,
            Axis::Straight { .. } => s,
        }
    }

    /// Position and radius of the section at a length along the tube, which lies on the surface of all its balls.
    pub(super) fn section(&self, s: f64) -> (DVec3, f64) {
        (self.at(s).0, self.profile.section(self.along(s)))
    }

    /// The length along a smooth tube at which the polyline has a length.
    fn place(&self, l: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.length());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.along(middle) < l { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The lengths between two others at which there must be sections: those at corners, and where the radius changes fast.
    pub(super) fn stops(&self, from: f64, to: f64) -> Vec<f64> {
        let mut found: Vec<f64> = self.mitres(from, to).iter().flat_map(Mitre::places).collect();
        found.extend(self.kinks(from, to));
        found.sort_by(f64::total_cmp);
        found
    }

    /// The lengths between two others at which the radius changes so fast that there must be sections, and where these have room.
    pub(super) fn kinks(&self, from: f64, to: f64) -> Vec<f64> {
        let mut taken = vec![(from, 0.0), (to, 0.0)];
        taken.extend(self.mitres(from, to).iter().map(|mitre| (mitre.at, mitre.reach())));
        let mut found = Vec::new();
        for &kink in self.kinks.iter().filter(|kink| (from..to).contains(*kink)) {
            let room = KINK_ROOM * self.at(kink).1;
            if taken.iter().all(|(at, reach)| (kink - at).abs() >= reach + room) {
                found.push(kink);
                taken.push((kink, 0.0));
            }
        }
        found
    }

    /// Direction along the tube.
    pub(super) fn tangent(&self, s: f64) -> DVec3 {
        let direct = match &self.axis {
            Axis::Smooth { curve, lengths } => curve.derivative(lengths.parameter(s)).normalize_or_zero(),
            Axis::Straight { points, lengths } => {
                let k = segment(lengths, s);
                (points[k + 1].0 - points[k].0).normalize_or_zero()
            }
        };
        if direct != DVec3::ZERO {
            return direct;
        }
        let h = 1e-3 * self.length();
        let (a, b) = (self.at((s - h).max(0.0)).0, self.at((s + h).min(self.length())).0);
        (b - a).normalize_or(DVec3::X)
    }

    /// The samples between two lengths at which the axis has a corner.
    pub(super) fn mitres(&self, from: f64, to: f64) -> Vec<Mitre> {
        let Axis::Straight { points, lengths } = &self.axis else { return Vec::new() };
        let mitre = |k: usize| {
            let directions = [k - 1, k].map(|k| (points[k + 1].0 - points[k].0).normalize_or_zero());
            let cosine = directions[0].dot(directions[1]);
            let tangent = half_tangent(cosine);
            let (at, radius) = (lengths[k], points[k].1);
            let room = (at - lengths[k - 1]).min(lengths[k + 1] - at);
            let is_shared = is_shared(cosine, room / radius);
            Mitre { at, directions, tangent, radius, is_shared }
        };
        (1..points.len() - 1).filter(|k| lengths[*k] > from && lengths[*k] < to).map(mitre).collect()
    }

    /// The least length from a node, at least `s`, at which a section has room beside the sections at corners: past those that are too near.
    fn beside_corners(&self, mut s: f64, first: bool) -> f64 {
        let mut kinks = self.kinks.clone();
        if !first {
            kinks.reverse();
        }
        for kink in kinks {
            let at = if first { kink } else { self.length() - kink };
            if at > s && at - s < KINK_ROOM * self.at(kink).1 {
                s = at;
            }
        }
        let mut mitres = self.mitres(0.0, self.length());
        if !first {
            mitres.reverse();
        }
        for mitre in mitres {
            let at = if first { mitre.at } else { self.length() - mitre.at };
            // Where the tube tapers, the section at the end is wider than that in the corner.
            let width = self.section(if first { s } else { self.length() - s }).1;
            let room = mitre.reach().max(mitre.tangent * width) / ROOM;
            if (at - s).abs() < room {
                s = at + room * (1.0 + 1e-9);
            }
        }
        s
    }

    /// Whether the sections at corners between two lengths are disjoint, and disjoint from those at the ends.
    pub(super) fn has_room(&self, from: f64, to: f64) -> bool {
        let mut last = (from, 0.0);
        let mitres = self.mitres(from, to);
        let mut ends = mitres.iter().map(|mitre| (mitre.at, mitre.reach())).chain([(to, 0.0)]);
        mitres.is_empty()
            || ends.all(|(at, reach)| {
                let (before, taken) = std::mem::replace(&mut last, (at, reach));
                taken + reach <= ROOM * (at - before)
            })
    }
}

/// The segment that contains a length.
fn segment(lengths: &[f64], s: f64) -> usize {
    lengths.partition_point(|&l| l <= s).clamp(1, lengths.len() - 1) - 1
}

/// The lengths of the polyline up to each point.
fn lengths_along(points: &[(DVec3, f64)]) -> Vec<f64> {
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].0.distance(pair[1].0));
    }
    lengths
}

/// Halvings of the part of a tube that contains a length of the polyline.
const HALVINGS: usize = 50;

/// Smallest distance of a section where the radius changes fast from another one, in radii.
const KINK_ROOM: f64 = 0.25;

/// Largest distance of a smooth axis from the polyline through the samples, over the radius.
const WITHIN: f64 = 0.1;

/// The tube through samples: smooth if the spline is within the tolerance of them, otherwise the polyline with a mitre at each sample. If the
/// mitres have no room or `is_moved` asks for it, the samples are moved until the spline can be meshed.
fn tube(samples: Vec<usize>, through: &[(DVec3, f64)], factor: f64, is_moved: bool) -> Tube {
    let mut points = through.to_vec();
    relax(&mut points);
    let moved = deviation(&points, through);
    if moved <= WITHIN {
        return Tube::smooth(samples, &points, factor, 0.0);
    }
    let corners = thinned(through).into_iter().map(|k| through[k]).collect();
    let straight = Tube::straight(samples, corners, factor);
    let length = straight.length();
    let is_slanted = |mitre: &Mitre| is_beyond_mitres(mitre.directions[0].dot(mitre.directions[1]));
    if !is_moved && straight.has_room(0.0, length) && !straight.mitres(0.0, length).iter().any(is_slanted) {
        return straight;
    }
    Tube::smooth(straight.samples, &points, factor, moved)
}

/// The first sample and the last.
fn ends(samples: &[usize]) -> [usize; 2] {
    [samples[0], samples[samples.len() - 1]]
}

/// Largest number of cones of a tube.
const MOST_CONES: f64 = 20_000.0;

/// A tube as seen from a node at one of its ends.
#[derive(Clone, Copy, PartialEq, Eq)]
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

    /// Position and radius of a section.
    pub(super) fn section(self, tubes: &[Tube], s: f64) -> (DVec3, f64) {
        let tube = &tubes[self.tube];
        tube.section(if self.first { s } else { tube.length() - s })
    }

    pub(super) fn tangent(self, tubes: &[Tube], s: f64) -> DVec3 {
        let tube = &tubes[self.tube];
        if self.first { tube.tangent(s) } else { -tube.tangent(tube.length() - s) }
    }

    /// The least length, at least `s`, at which a section has room beside the corners of the tube.
    pub(super) fn beside_corners(self, tubes: &[Tube], s: f64) -> f64 {
        tubes[self.tube].beside_corners(s, self.first)
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
/// Radii are multiplied by a factor. The samples of tubes for which `is_moved` is set are moved where the tube turns.
pub(super) fn tubes(
    skeleton: &Skeleton,
    (factor, division): (f64, Division),
    is_moved: &[bool],
) -> Vec<Tube> {
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
    let parts = paths.into_iter().enumerate().flat_map(|(branch, path)| {
        let points = balls(skeleton, &path, factor);
        let are_tips =
            [path[0], path[path.len() - 1]].map(|end| skeleton.degree(end) == 1 && !is_ball(skeleton, end));
        divided(&path, &points, (division, are_tips)).into_iter().map(move |part| (branch, part))
    });
    let is_moved = |index: usize| is_moved.get(index).is_some_and(|is| *is);
    parts
        .enumerate()
        .map(|(index, (branch, (path, points)))| Tube {
            branch,
            ..tube(path, &points, factor, is_moved(index))
        })
        .collect()
}

/// The balls of a path; those at its ends have the radius of the neighbour where they lie in a soma.
fn balls(skeleton: &Skeleton, path: &[usize], factor: f64) -> Vec<(DVec3, f64)> {
    let (samples, last) = (skeleton.samples(), path.len() - 1);
    let mut points: Vec<(DVec3, f64)> =
        path.iter().map(|&i| (samples[i].position, factor * samples[i].radius)).collect();
    if is_ball(skeleton, path[0]) {
        points[0].1 = points[1.min(last)].1;
    }
    if is_ball(skeleton, path[last]) {
        points[last].1 = points[last.saturating_sub(1)].1;
    }
    points
}
