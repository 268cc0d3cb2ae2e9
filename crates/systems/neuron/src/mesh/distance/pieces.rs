//! Parts of the surfaces of cones, and the bounds on their distance from the wall.

use super::boxes::Boxes;
use super::search::{Bounds, Patch};
use super::solid::Solid;
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::geom::point_triangle::near_weights;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};
use std::f64::consts::TAU;

/// Parts of the circumference of a cone in the beginning.
const ARCS: usize = 8;

/// Length of a part of a cone in the beginning, in radii.
const PART: f64 = 1.0;

/// Most parts along a cone in the beginning.
const MOST_PARTS: f64 = 1e5;

/// A point of the surface counts as visible if it is no deeper inside another cone, in radii.
const DEPTH: f64 = 0.05;

/// A piece is not divided any more if its points are closer to its centre than this share of how far the triangles next to it may be from
/// the wall that they stand for.
const SETTLED: f64 = 0.25;

/// Most parts of cones that are looked at for the depth of a point.
const MOST_CANDIDATES: usize = 20_000;

/// A triangle of the wall, and a bound on its distance from the wall that it stands for, both ways.
pub(super) type Facet = ([DVec3; 3], f64);

/// The wall as triangles.
pub(super) struct Facets {
    list: Vec<Facet>,
    boxes: Boxes,
    /// The greatest of the bounds.
    most: f64,
}

/// The nearest point of the wall.
struct Foot {
    facet: usize,
    lower: f64,
    upper: f64,
}

impl Facets {
    pub(super) fn new(facets: Vec<Facet>) -> Self {
        let boxes: Vec<[DVec3; 2]> =
            facets.iter().map(|([a, b, c], _)| [a.min(*b).min(*c), a.max(*b).max(*c)]).collect();
        let most = facets.iter().map(|(_, off)| *off).fold(0.0, f64::max);
        Self { boxes: Boxes::new(&boxes), list: facets, most }
    }

    /// A point of a facet that is nearest to `p`, up to rounding.
    fn foot(&self, facet: usize, p: DVec3) -> DVec3 {
        let [a, b, c] = self.list[facet].0;
        let [y, z] = near_weights(p.to_array(), [a.to_array(), b.to_array(), c.to_array()]);
        a * (1.0 - (y + z)).max(0.0) + b * y + c * z
    }

    /// Calls `visit` with each facet that may stand for a part of the wall within a distance of a point.
    fn near(&self, p: DVec3, distance: f64, mut visit: impl FnMut(usize)) {
        let distance = distance + self.most;
        self.boxes.visit(p, distance, |index| {
            visit(index as usize);
            distance
        });
    }

    fn nearest(&self, p: DVec3) -> Foot {
        let mut found = Foot { facet: 0, lower: f64::INFINITY, upper: f64::INFINITY };
        self.boxes.visit(p, f64::INFINITY, |index| {
            let (facet, off) = &self.list[index as usize];
            let foot = self.foot(index as usize, p);
            let distance = p.distance(foot);
            // No point of a triangle is nearer than a plane that separates it from the point.
            let normal = (p - foot).normalize_or_zero();
            let lower = facet.iter().map(|v| normal.dot(p - *v)).fold(f64::INFINITY, f64::min);
            found.lower = found.lower.min(lower - off);
            if distance + off < found.upper {
                (found.facet, found.upper) = (index as usize, distance + off);
            }
            found.upper + self.most
        });
        found
    }

    /// A bound on the distance of all points of a convex hull from a facet and the wall that it stands for.
    fn within(&self, facet: usize, hull: &[DVec3]) -> f64 {
        let far = hull.iter().map(|p| p.distance(self.foot(facet, *p))).fold(0.0, f64::max);
        far + self.list[facet].1
    }
}

/// A plane through a sample at which the mesh ends flat: what is beyond it is not part of the surface that is compared.
#[derive(Clone, Copy)]
pub(super) struct FlatEnd {
    pub(super) sample: usize,
    pub(super) outwards: DVec3,
}

/// A part of the surface of a cone.
#[derive(Clone, Copy)]
pub(super) enum Piece {
    /// A part of its side, between two parameters along the axis and two angles.
    Side { cone: u32, along: [f64; 2], angles: [f64; 2] },
    /// A part of a ball, as a triangle of unit vectors.
    Ball { centre: DVec3, radius: f64, sample: u32, corners: [DVec3; 3] },
}

impl Patch for Piece {
    fn divided(&self) -> [Self; 4] {
        match *self {
            Self::Side { cone, along: [a, b], angles: [p, q] } => {
                let (m, r) = (0.5 * (a + b), 0.5 * (p + q));
                let part = |along, angles| Self::Side { cone, along, angles };
                [part([a, m], [p, r]), part([a, m], [r, q]), part([m, b], [p, r]), part([m, b], [r, q])]
            }
            Self::Ball { centre, radius, sample, corners: [a, b, c] } => {
                let [d, e, f] = [(a + b), (b + c), (c + a)].map(DVec3::normalize_or_zero);
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]].map(|corners| Self::Ball {
                    centre,
                    radius,
                    sample,
                    corners,
                })
            }
        }
    }
}

/// What is compared with the wall.
pub(super) struct Surface<'s> {
    solid: &'s Solid,
    facets: &'s Facets,
    /// Planes of flat ends, for the samples whose balls they cut: a point in the plane, and its normal.
    planes: BTreeMap<u32, (DVec3, DVec3)>,
}

/// A piece in space.
struct Shape {
    /// Its convex hull contains the piece.
    hull: [DVec3; 6],
    /// A point of it.
    centre: DVec3,
    /// The least and the greatest radius.
    radii: [f64; 2],
    sample: usize,
}

impl Shape {
    /// No point of the hull is farther from the centre.
    fn reach(&self) -> f64 {
        self.hull.iter().map(|p| p.distance(self.centre)).fold(0.0, f64::max)
    }

    /// Whether all of it is inside another cone.
    fn is_hidden(&self, solid: &Solid) -> bool {
        let mut is_hidden = false;
        solid.near(self.centre, self.reach(), |cone| is_hidden |= cone.within(&self.hull) < -solid.rounding);
        is_hidden
    }
}

impl<'s> Surface<'s> {
    pub(super) fn new(solid: &'s Solid, facets: &'s Facets, skeleton: &Skeleton, ends: &[FlatEnd]) -> Self {
        let samples = skeleton.samples();
        let mut planes = BTreeMap::new();
        for end in ends {
            let tip = samples[end.sample].position;
            // Balls of samples behind the end may reach beyond it.
            let (mut last, mut next) = (None, Some(end.sample));
            while let Some(sample) = next {
                if samples[sample].position.distance(tip) > samples[sample].radius {
                    break;
                }
                planes.insert(sample as u32, (tip, end.outwards));
                let neighbours = skeleton.children(sample).iter().copied().chain(skeleton.parent(sample));
                let mut others = neighbours.filter(|other| Some(*other) != last);
                next = others.next().filter(|_| others.next().is_none());
                last = Some(sample);
            }
        }
        Self { solid, facets, planes }
    }

    /// The sides of all cones and the balls of all samples, in parts of about a radius.
    pub(super) fn pieces(&self) -> Vec<Piece> {
        pieces_of(self.solid, 0..self.solid.cones.len())
    }

    /// Bounds on the distance of the points of a piece from the wall; `None` if all of it is inside another cone, or beyond a flat
    /// end.
    pub(super) fn bounds(&self, piece: &Piece) -> Option<Bounds> {
        let solid = self.solid;
        let shape = shape(self.solid, piece);
        let plane = match piece {
            Piece::Ball { sample, .. } => self.planes.get(sample),
            // Sides of cones that taper towards an end reach beyond it, too.
            Piece::Side { cone, .. } => {
                let ends = solid.cones[*cone as usize].samples;
                ends.iter().find_map(|sample| self.planes.get(&(*sample as u32)))
            }
        };
        let beyond = |p: DVec3| plane.map_or(f64::NEG_INFINITY, |(tip, normal)| (p - *tip).dot(*normal));
        if shape.hull.iter().all(|p| beyond(*p) > solid.rounding) || shape.is_hidden(solid) {
            return None;
        }
        let reach = shape.reach();
        let Shape { hull, centre, radii, sample } = shape;
        let foot = self.facets.nearest(centre);
        let covered = self.facets.within(foot.facet, &hull);
        let upper = covered.min(foot.upper + reach) + solid.rounding;
        let depth = solid.exit(&[centre], centre, solid.rounding);
        let mut lower = 0.0;
        if depth <= DEPTH * radii[0] && beyond(centre) + depth < -solid.rounding {
            // The surface of the union is no farther away than the depth.
            lower = (foot.lower - depth - solid.rounding).max(0.0);
        }
        let is_settled = reach < SETTLED * self.facets.list[foot.facet].1;
        Some(Bounds {
            upper: [upper, upper / radii[0]],
            lower: [lower, lower / radii[1]],
            sample,
            is_settled,
        })
    }

    /// For each facet whether it may stand for the part of the wall that is next to a point of one of the pieces.
    pub(super) fn next_to(&self, pieces: &[Piece]) -> Vec<bool> {
        let mut found = vec![false; self.facets.list.len()];
        for piece in pieces {
            let shape = shape(self.solid, piece);
            let (centre, reach) = (shape.centre, shape.reach());
            // Of two points that are so far apart, distances differ by no more.
            let most = self.facets.nearest(centre).upper + 2.0 * reach + self.solid.rounding;
            self.facets.near(centre, most, |facet| found[facet] = true);
        }
        found
    }
}

/// The sides of cones and the balls at their ends, in parts of about a radius.
fn pieces_of(solid: &Solid, cones: impl Iterator<Item = usize>) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut balls: BTreeMap<u32, (DVec3, f64)> = BTreeMap::new();
    for index in cones {
        let cone = &solid.cones[index];
        for side in 0..2 {
            let ball = balls.entry(cone.samples[side] as u32);
            let (centre, radius) = (cone.shape.ends[side], cone.shape.radii[side]);
            let known = ball.or_insert((centre, radius));
            known.1 = known.1.max(radius);
        }
        if cone.lateral_slope().is_none() {
            continue;
        }
        let length = cone.shape.ends[0].distance(cone.shape.ends[1]);
        let radius = 0.5 * (cone.shape.radii[0] + cone.shape.radii[1]);
        let parts = (length / (PART * radius)).ceil().clamp(1.0, MOST_PARTS);
        for k in 0..parts as usize {
            let along = [k as f64 / parts, (k + 1) as f64 / parts];
            for arc in 0..ARCS {
                let angles = [arc, arc + 1].map(|k| TAU * k as f64 / ARCS as f64);
                pieces.push(Piece::Side { cone: index as u32, along, angles });
            }
        }
    }
    for (sample, (centre, radius)) in balls {
        for octant in 0..8 {
            let sign = |axis: usize| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 };
            let corners = [DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2)];
            pieces.extend(Piece::Ball { centre, radius, sample, corners }.divided());
        }
    }
    pieces
}

fn shape(solid: &Solid, piece: &Piece) -> Shape {
    match *piece {
        Piece::Side { cone, along, angles } => {
            let cone = &solid.cones[cone as usize];
            let [a, b] = cone.shape.ends;
            let axis = (b - a).normalize_or(DVec3::X);
            let e1 = axis.any_orthonormal_vector();
            let e2 = axis.cross(e1);
            let slope = cone.lateral_slope().unwrap_or_default();
            let cosine = (1.0 - slope * slope).sqrt();
            let middle = 0.5 * (angles[0] + angles[1]);
            let normal = |angle: f64, stretch: f64| {
                (e1 * libm::cos(angle) + e2 * libm::sin(angle)) * (cosine * stretch) - axis * slope
            };
            let wide = 1.0 / libm::cos(0.5 * (angles[1] - angles[0]));
            let normals = [normal(angles[0], 1.0), normal(angles[1], 1.0), normal(middle, wide)];
            let at = |t: f64, n: DVec3| a.lerp(b, t) + n * cone.radius(t);
            let hull = std::array::from_fn(|k| at(along[k / 3], normals[k % 3]));
            let t = 0.5 * (along[0] + along[1]);
            let ends = along.map(|t| cone.radius(t));
            let radii = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let sample = cone.samples[usize::from(t > 0.5)];
            Shape { hull, centre: at(t, normal(middle, 1.0)), radii, sample }
        }
        Piece::Ball { centre, radius, sample, corners: [a, b, c] } => {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            // The triangle lies inside of the ball; stretched by this factor, outside.
            let stretch = 1.0 / normal.dot(a).abs();
            let at = |v: DVec3| centre + v * radius;
            let hull = [at(a), at(b), at(c), at(a * stretch), at(b * stretch), at(c * stretch)];
            let centre = at((a + b + c).normalize_or(a));
            Shape { hull, centre, radii: [radius; 2], sample: sample as usize }
        }
    }
}

/// A part of the surface of cones that may be next to a point, ordered by a bound on its distance, the least first.
struct Candidate {
    lower: f64,
    piece: Piece,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower.total_cmp(&self.lower)
    }
}

/// A lower bound on the distance of a point inside the union from its surface, at most `width` below it; `most` bounds it from above.
///
/// Parts of cones are divided, the nearest first, until the nearest one that is not inside another cone is small.
pub(super) fn depth(solid: &Solid, p: DVec3, most: f64, width: f64) -> f64 {
    let candidate = |piece: Piece| {
        let shape = shape(solid, &piece);
        Candidate { lower: shape.centre.distance(p) - shape.reach() - solid.rounding, piece }
    };
    let most = most + solid.rounding;
    let cones = solid.numbers_near(p, most).into_iter();
    let mut open: BinaryHeap<Candidate> = pieces_of(solid, cones).into_iter().map(candidate).collect();
    let mut left = MOST_CANDIDATES;
    while let Some(Candidate { lower, piece }) = open.pop() {
        let shape = shape(solid, &piece);
        left -= 1;
        // Of two points of the hull, the distances differ by twice the reach at most.
        if left == 0 || lower >= most || (2.0 * shape.reach() <= width && !shape.is_hidden(solid)) {
            return lower.clamp(0.0, most);
        }
        if !shape.is_hidden(solid) {
            open.extend(piece.divided().map(candidate));
        }
    }
    most
}
