//! Pieces on a strip that may overlap, and what overlaps cost.

use super::body::{Body, Energy, Pose, Push, Sum, edges, is_near, pair};
use super::near::Near;
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::Point;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Pieces on a strip, which may overlap.
pub(super) struct Strip<'b> {
    pub(super) bodies: &'b [Body],
    pub(super) poses: Vec<Pose>,
    /// Width and length of the strip.
    pub(super) size: [f64; 2],
    /// Side of a piece.
    pub(super) unit: f64,
    pub(super) kerf: f64,
    pub(super) near: Near,
    /// What is particular of pairs.
    pairs: FxHashMap<(u32, u32), Particular>,
    /// The most that a pair keeps more.
    most_more: f64,
    pub(super) random: Random,
    /// Pairs of pieces that were looked at.
    pub(super) work: u64,
}

/// The weight of a pair that overlapped, and the distance that it keeps more than others.
#[derive(Clone, Copy, Debug)]
struct Particular {
    weight: f64,
    more: f64,
}

/// What pairs keep more than the cut, relative to the side of a piece: fields err by so much.
const SPARE: f64 = 2e-3;

/// The depth that counts as none, relative to the side of a piece.
const NO_DEPTH: f64 = 1e-3;

/// What pieces keep more from edges: the depth that counts as none, and the distance of corners from their samples.
const EDGE_SPARE: f64 = 3e-3;

/// How much overlaps with an edge cost, relative to those of pieces.
const EDGE_WEIGHT: f64 = 4.0;

/// What weights of pairs that overlap grow by, at least and for the deepest pair, and what is left of the weight of others.
const LEAST_GROWTH: f64 = 1.2;
const GROWTH: f64 = 0.6;
const DECAY: f64 = 0.95;

/// Weights that differ from 1 by less are forgotten.
const NO_WEIGHT: f64 = 0.01;

impl<'b> Strip<'b> {
    /// Pieces on a strip of some width, whose length is where they end.
    pub(super) fn new(bodies: &'b [Body], poses: Vec<Pose>, width: f64, unit: f64, kerf: f64) -> Self {
        let radius = bodies.iter().map(|body| body.radius).fold(0.0, f64::max);
        let length = end(bodies, &poses) + 0.5 * kerf;
        let mut strip = Self {
            bodies,
            poses,
            size: [width, length],
            unit,
            kerf,
            near: Near::new([width, length], 2.0 * (radius + kerf) + unit),
            pairs: FxHashMap::default(),
            most_more: 0.0,
            random: Random::new(1),
            work: 0,
        };
        strip.near.fill(&strip.poses);
        strip
    }

    /// The depth that counts as none.
    pub(super) fn no_depth(&self) -> f64 {
        NO_DEPTH * self.unit
    }

    /// The weight of a pair, and the distance that it keeps.
    fn of_pair(&self, i: usize, j: usize) -> (f64, f64) {
        let gap = self.kerf + SPARE * self.unit;
        self.pairs.get(&key(i, j)).map_or((1.0, gap), |own| (own.weight, gap + own.more))
    }

    /// Visits the pieces that may be too near to a piece at a place.
    #[inline]
    fn each_near(&self, piece: usize, pose: &Pose, mut visit: impl FnMut(usize)) {
        let gap = self.kerf + SPARE * self.unit + self.most_more;
        self.near.each(pose.at, |other| {
            let bodies = [&self.bodies[piece], &self.bodies[other]];
            if other != piece && is_near(bodies, [pose, &self.poses[other]], gap) {
                visit(other);
            }
        });
    }

    /// What a pair adds up to, with its weight.
    #[inline]
    fn pair<S: Sum>(&self, [i, j]: [usize; 2], poses: [&Pose; 2]) -> (f64, S) {
        let (weight, gap) = self.of_pair(i, j);
        let mut sum = S::default();
        pair([&self.bodies[i], &self.bodies[j]], poses, gap, &mut sum);
        (weight, sum)
    }

    /// What a piece at a place and the edges add up to.
    #[inline]
    fn at_edges<S: Sum>(&self, piece: usize, pose: &Pose) -> S {
        let mut sum = S::default();
        let gap = 0.5 * self.kerf + EDGE_SPARE * self.unit;
        edges(&self.bodies[piece], pose, self.size, gap, &mut sum);
        sum
    }

    /// What neighbours, except for one, and edges do to a piece at a place, and the number of pairs looked at.
    pub(super) fn push(&self, piece: usize, pose: &Pose, without: usize) -> (Push, u64) {
        let (mut all, mut work) = (Push::default(), 0);
        self.each_near(piece, pose, |other| {
            if other != without {
                let (weight, push) = self.pair([piece, other], [pose, &self.poses[other]]);
                all.add_weighted(&push, weight);
                work += 1;
            }
        });
        all.add_weighted(&self.at_edges(piece, pose), EDGE_WEIGHT);
        (all, work)
    }

    /// What a piece at a place costs without one other piece, and the number of pairs looked at; ends once it is above a value.
    pub(super) fn energy(&self, piece: usize, pose: &Pose, without: usize, most: f64) -> (f64, u64) {
        let (mut all, mut work) = (EDGE_WEIGHT * self.at_edges::<Energy>(piece, pose).0, 0);
        self.each_near(piece, pose, |other| {
            if other != without && all <= most {
                let (weight, sum) = self.pair::<Energy>([piece, other], [pose, &self.poses[other]]);
                all += weight * sum.0;
                work += 1;
            }
        });
        (all, work)
    }

    /// What two pieces at new places cost each other.
    pub(super) fn energy_of_pair(&self, pieces: [usize; 2], poses: [&Pose; 2]) -> f64 {
        let (weight, sum) = self.pair::<Energy>(pieces, poses);
        weight * sum.0
    }

    /// What all pieces are pushed by; those of which no neighbour has moved, by what they were before.
    pub(super) fn pushes(&mut self, before: &[Push], has_moved: &[bool]) -> Vec<Push> {
        self.near.fill(&self.poses);
        let found: Vec<(Push, u64)> = (0..self.poses.len())
            .into_par_iter()
            .map(|i| {
                let mut is_stale = has_moved[i];
                self.each_near(i, &self.poses[i], |j| is_stale |= has_moved[j]);
                if is_stale { self.push(i, &self.poses[i], i) } else { (before[i], 0) }
            })
            .collect();
        self.work += found.iter().map(|(_, work)| work).sum::<u64>();
        found.into_iter().map(|(push, _)| push).collect()
    }

    /// Makes pairs that overlap heavier, the deeper the more, and the others lighter.
    pub(super) fn weigh(&mut self) {
        let overlaps = |i: usize| {
            let mut all = Vec::new();
            self.each_near(i, &self.poses[i], |j| {
                if j > i {
                    let (_, push) = self.pair::<Push>([i, j], [&self.poses[i], &self.poses[j]]);
                    if push.deepest > self.no_depth() {
                        all.push((j, push.energy));
                    }
                }
            });
            all
        };
        let found: Vec<Vec<(usize, f64)>> = (0..self.poses.len()).into_par_iter().map(overlaps).collect();
        let most = found.iter().flatten().map(|(_, energy)| *energy).fold(0.0, f64::max);
        self.pairs.retain(|_, own| {
            own.weight = 1.0 + DECAY * (own.weight - 1.0);
            own.weight > 1.0 + NO_WEIGHT || own.more > 0.0
        });
        for (i, others) in found.into_iter().enumerate() {
            for (j, energy) in others {
                self.particular(i, j).weight *= LEAST_GROWTH + GROWTH * (energy / most).sqrt();
            }
        }
    }

    fn particular(&mut self, i: usize, j: usize) -> &mut Particular {
        self.pairs.entry(key(i, j)).or_insert(Particular { weight: 1.0, more: 0.0 })
    }

    /// Keeps a pair farther apart by a distance.
    pub(super) fn keep_more(&mut self, i: usize, j: usize, by: f64) {
        let own = self.particular(i, j);
        own.more += by;
        let more = own.more;
        self.most_more = self.most_more.max(more);
    }

    /// Starts again from some poses, on a strip of another length; pieces come nearer to each other by the same factor.
    pub(super) fn restart(&mut self, poses: &[Pose], from: f64, to: f64) {
        self.poses.clear();
        self.poses.extend_from_slice(poses);
        self.size[1] = from;
        self.scale(to / from);
        self.pairs.clear();
        self.most_more = 0.0;
    }

    /// Makes the strip longer by a factor, and pieces farther apart along it.
    pub(super) fn scale(&mut self, factor: f64) {
        for pose in &mut self.poses {
            pose.at[1] *= factor;
        }
        self.size[1] *= factor;
    }

    /// Puts a piece somewhere else.
    pub(super) fn put(&mut self, piece: usize, pose: Pose) {
        self.near.shift(piece, self.poses[piece].at, pose.at);
        self.poses[piece] = pose;
    }

    /// The length of strip that the pieces need.
    pub(super) fn length(&self) -> f64 {
        end(self.bodies, &self.poses) + 0.5 * self.kerf
    }

    /// The paths of all pieces.
    pub(super) fn paths(&self) -> Vec<Vec<Point>> {
        let laid = self.bodies.iter().zip(&self.poses);
        laid.map(|(body, pose)| body.path.iter().map(|p| pose.apply(*p)).collect()).collect()
    }
}

fn key(i: usize, j: usize) -> (u32, u32) {
    (i.min(j) as u32, i.max(j) as u32)
}

/// Where the last path ends along a strip.
fn end(bodies: &[Body], poses: &[Pose]) -> f64 {
    let laid = bodies.iter().zip(poses);
    laid.flat_map(|(body, pose)| body.path.iter().map(|p| pose.apply(*p)[1])).fold(0.0, f64::max)
}
