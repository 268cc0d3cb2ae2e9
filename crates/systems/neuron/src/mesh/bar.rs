//! A core for several nodes on one thick tube: a row of cubes along it, one for each place where thin tubes leave it.

use super::assign::{Assignment, angle, hungarian};
use super::cluster::{Cluster, THIN};
use super::core::Core;
use super::tube::{End, Tube};
use glam::{DMat3, DVec3};

/// Half the width of a cube, over the radius of the tube.
const HALF: f64 = 0.3;

/// Length of the tube before the first place and beyond the last that the row takes, at most, in radii.
const BEFORE: f64 = 0.42;

/// The same over the length that there is.
const SHARE: f64 = 0.5;

/// Places that are closer together, in radii, have one cube.
const SAME: f64 = 0.3;

/// Cosine of the largest turn of the tube from one of its parts to the next.
const MOST_TURN: f64 = 0.5;

/// Steps in which the path, and the part of a thin tube within the thick one, are divided.
const STEPS: usize = 40;

/// Directions of the cubes about the tube that are tried.
const TURNS: usize = 9;

/// Weight of the squared distance between the place of a tube and its cube, in radii, beside the squared angle in radians.
const APART: f64 = 4.0;

/// Rows of cubes for a cluster, each with an assignment of its tubes, the best first; none if its nodes do not lie on one thick tube.
pub(super) fn bars(
    (cluster, tubes, reach): (&Cluster, &[Tube], &[f64]),
    most: usize,
) -> Vec<(Core, Assignment)> {
    let Some(path) = Path::of((cluster, tubes, reach)) else { return Vec::new() };
    let places: Vec<Option<f64>> = (0..cluster.ends.len())
        .map(|arm| (!path.arms.contains(&arm)).then(|| path.leaves(cluster.ends[arm], tubes, reach[arm])))
        .collect();
    let Some(limits) = path.limits(&places) else { return Vec::new() };
    let mut found: Vec<(Core, Assignment)> = Vec::new();
    for turn in 0..TURNS {
        let turn = std::f64::consts::FRAC_PI_2 * turn as f64 / TURNS as f64;
        let core = path.core(&limits, turn);
        if core.quads.len() < cluster.ends.len() {
            return Vec::new();
        }
        let assignment = path.assignment(&core, (cluster, tubes, reach), &places);
        match found.iter_mut().find(|(_, other)| other.quads == assignment.quads) {
            Some((_, other)) if other.score <= assignment.score => (),
            Some(same) => *same = (core, assignment),
            None => found.push((core, assignment)),
        }
    }
    found.sort_by(|a, b| a.1.score.total_cmp(&b.1.score));
    found.truncate(most);
    found
}

/// The axis of the thick tube, from the section at the end of one of its arms to that of the other.
struct Path {
    /// Lengths, positions and radii.
    balls: Vec<(f64, DVec3, f64)>,
    /// The arms at its beginning and end.
    arms: [usize; 2],
}

impl Path {
    fn of((cluster, tubes, reach): (&Cluster, &[Tube], &[f64])) -> Option<Self> {
        if !cluster.balls.is_empty() {
            return None;
        }
        let chain = chain(cluster, tubes)?;
        let (start, end) = (*chain.first()?, *chain.last()?);
        let back = End { tube: end.tube, first: !end.first };
        let first = going_on((cluster, tubes, reach), start)?;
        let last = going_on((cluster, tubes, reach), back)?;
        let part =
            |end: End, length: f64| (0..=STEPS).map(move |k| end.at(tubes, length * k as f64 / STEPS as f64));
        let arm = |arm: usize| part(cluster.ends[arm], reach[arm]);
        let before: Vec<(DVec3, f64)> = arm(first).collect();
        let inside = chain.iter().flat_map(|end| part(*end, tubes[end.tube].length()));
        let mut balls: Vec<(f64, DVec3, f64)> = Vec::new();
        for (p, radius) in before.into_iter().rev().chain(inside).chain(arm(last)) {
            let length = balls.last().map_or(0.0, |(length, before, _)| length + before.distance(p));
            if balls.last().is_none_or(|last| length > last.0) {
                balls.push((length, p, radius));
            }
        }
        let path = Self { balls, arms: [first, last] };
        (path.balls.len() > 1 && path.is_straight()).then_some(path)
    }

    /// Whether it turns nowhere too sharply within a radius.
    fn is_straight(&self) -> bool {
        let radius = self.balls.iter().map(|ball| ball.2).sum::<f64>() / self.balls.len() as f64;
        let length = self.length();
        let steps = (length / radius).ceil().max(2.0) as usize;
        let ways: Vec<DVec3> = (0..steps)
            .map(|k| {
                let [a, b] = [k, k + 1].map(|k| self.at(length * k as f64 / steps as f64).0);
                (b - a).normalize_or_zero()
            })
            .collect();
        ways.windows(2).all(|pair| pair[0].dot(pair[1]) >= MOST_TURN)
    }

    fn length(&self) -> f64 {
        self.balls[self.balls.len() - 1].0
    }

    /// Position and radius at a length.
    fn at(&self, s: f64) -> (DVec3, f64) {
        let k = self.balls.partition_point(|ball| ball.0 <= s).clamp(1, self.balls.len() - 1);
        let [(a, p, r), (b, q, t)] = [self.balls[k - 1], self.balls[k]];
        let share = ((s - a) / (b - a)).clamp(0.0, 1.0);
        (p.lerp(q, share), r + (t - r) * share)
    }

    /// The direction at a length, over a radius.
    fn direction(&self, s: f64) -> DVec3 {
        let (_, radius) = self.at(s);
        let [a, b] = [s - 0.5 * radius, s + 0.5 * radius].map(|s| self.at(s.clamp(0.0, self.length())).0);
        (b - a).normalize_or(DVec3::X)
    }

    /// The length of the place nearest to a point, and the depth of the point inside the ball there.
    fn nearest(&self, p: DVec3) -> (f64, f64) {
        let depth = |ball: &(f64, DVec3, f64)| (ball.0, ball.2 - p.distance(ball.1));
        self.balls
            .iter()
            .map(depth)
            .fold((0.0, f64::NEG_INFINITY), |best, next| if next.1 > best.1 { next } else { best })
    }

    /// The length next to which a tube leaves it.
    fn leaves(&self, end: End, tubes: &[Tube], reach: f64) -> f64 {
        let place = |k: usize| self.nearest(end.at(tubes, reach * k as f64 / STEPS as f64).0);
        (0..=STEPS).rev().map(place).find(|(_, depth)| *depth >= 0.0).unwrap_or_else(|| place(0)).0
    }

    /// The lengths between which the cubes are; `None` if there are fewer than two.
    fn limits(&self, places: &[Option<f64>]) -> Option<Vec<f64>> {
        let mut sorted: Vec<f64> = places.iter().flatten().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let mut centres: Vec<f64> = Vec::new();
        for place in sorted {
            let (_, radius) = self.at(place);
            match centres.last() {
                Some(last) if place - last < SAME * radius => (),
                _ => centres.push(place),
            }
        }
        let (&first, &last) = (centres.first()?, centres.last()?);
        if centres.len() < 2 {
            return None;
        }
        let before = |room: f64, radius: f64| (BEFORE * radius).min(SHARE * room);
        let mut limits = vec![first - before(first, self.at(first).1)];
        limits.extend(centres.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        limits.push(last + before(self.length() - last, self.at(last).1));
        Some(limits)
    }

    /// Cubes between these lengths, turned about the path.
    fn core(&self, limits: &[f64], turn: f64) -> Core {
        let (mut vertices, mut axis) = (Vec::new(), Vec::new());
        let mut side = self.direction(limits[0]).any_orthonormal_vector();
        for &s in limits {
            let (centre, radius) = self.at(s);
            let along = self.direction(s);
            side = side.reject_from(along).normalize_or(along.any_orthonormal_vector());
            let across = along.cross(side);
            for k in 0..4 {
                let angle = turn + std::f64::consts::FRAC_PI_2 * f64::from(k);
                let out = side * libm::cos(angle) + across * libm::sin(angle);
                vertices.push(centre + out * (std::f64::consts::SQRT_2 * HALF * radius));
                axis.push(centre);
            }
        }
        let block = |k: usize| std::array::from_fn(|v| 4 * k + v);
        Core::placed(vertices, axis, (0..limits.len() - 1).map(block).collect())
    }

    /// The assignment with the least angles between tubes and the quads of cubes next to them.
    fn assignment(
        &self,
        core: &Core,
        (cluster, tubes, reach): (&Cluster, &[Tube], &[f64]),
        places: &[Option<f64>],
    ) -> Assignment {
        let sides: Vec<Side> = core.quads.iter().map(|quad| Side::of(core, quad)).collect();
        let leaving = |(index, place): (usize, &Option<f64>)| {
            let is_first = index == self.arms[0];
            let (heart, radius) = self.at(place.unwrap_or(if is_first { 0.0 } else { self.length() }));
            let out = match place {
                Some(_) => (cluster.ends[index].at(tubes, reach[index]).0 - heart).normalize_or_zero(),
                None if is_first => -self.direction(0.0),
                None => self.direction(self.length()),
            };
            (Side { heart, out }, radius)
        };
        let arms: Vec<(Side, f64)> = places.iter().enumerate().map(leaving).collect();
        let cost: Vec<Vec<f64>> = arms
            .iter()
            .map(|(arm, radius)| sides.iter().map(|side| arm.cost(side, *radius)).collect())
            .collect();
        let quads = hungarian(&cost);
        let angles = arms.iter().zip(&quads).map(|((arm, _), &quad)| angle(arm.out, sides[quad].out));
        let (sum, greatest) = angles.fold((0.0, 0.0), |(sum, most), a: f64| (sum + a, a.max(most)));
        let score = sum / arms.len() as f64 + 0.5 * greatest;
        Assignment { rotation: DMat3::IDENTITY, quads, score }
    }
}

/// A side of a cube, or where a tube leaves: the middle of the cube or of the thick tube, and the direction out of it.
#[derive(Clone, Copy)]
struct Side {
    heart: DVec3,
    out: DVec3,
}

impl Side {
    fn of(core: &Core, quad: &[usize; 4]) -> Self {
        let middle = |of: &[usize]| of.iter().map(|&v| core.vertices[v]).sum::<DVec3>() / of.len() as f64;
        let block = core.blocks.iter().find(|block| quad.iter().all(|v| block.contains(v)));
        let heart = block.map_or(DVec3::ZERO, |block| middle(block));
        Self { heart, out: (middle(quad) - heart).normalize_or_zero() }
    }

    fn cost(&self, other: &Self, radius: f64) -> f64 {
        let apart = self.heart.distance(other.heart) / radius;
        angle(self.out, other.out).powi(2) + APART * apart * apart
    }
}

/// The tubes between the nodes of a cluster as one chain, each seen from the node where it begins; `None` if they branch.
fn chain(cluster: &Cluster, tubes: &[Tube]) -> Option<Vec<End>> {
    let at = |node: usize| {
        let inside = cluster.inside.iter();
        inside.filter(|&&tube| tubes[tube].nodes.contains(&node)).copied().collect::<Vec<usize>>()
    };
    let mut node = *cluster.samples.iter().find(|node| at(**node).len() == 1)?;
    let mut found: Vec<End> = Vec::new();
    loop {
        let before = found.last().map(|end| end.tube);
        let next: Vec<usize> = at(node).into_iter().filter(|tube| Some(*tube) != before).collect();
        match next[..] {
            [] => break,
            [tube] => {
                let first = tubes[tube].nodes[0] == node;
                found.push(End { tube, first });
                node = tubes[tube].nodes[usize::from(first)];
            }
            _ => return None,
        }
    }
    (found.len() == cluster.inside.len()).then_some(found)
}

/// The arm with which a chain goes on beyond the node where it begins: the straightest one that is not thin.
fn going_on((cluster, tubes, reach): (&Cluster, &[Tube], &[f64]), from: End) -> Option<usize> {
    let node = tubes[from.tube].nodes[usize::from(!from.first)];
    let (at, radius) = from.at(tubes, 0.0);
    let ahead = (from.at(tubes, radius.min(tubes[from.tube].length())).0 - at).normalize_or_zero();
    let arms = cluster.ends.iter().zip(reach).enumerate().filter(|(_, (end, reach))| {
        let is_thick = end.at(tubes, **reach).1 > THIN * radius;
        is_thick && tubes[end.tube].nodes[usize::from(!end.first)] == node
    });
    let straight =
        arms.map(|(arm, (end, &reach))| (-(end.at(tubes, reach).0 - at).normalize_or_zero().dot(ahead), arm));
    let best = straight.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 >= MOST_TURN).then_some(best.1)
}
