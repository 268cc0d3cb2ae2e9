//! Iterated closest points with robust weights.

use super::super::equations::Equations;
use super::super::registration::Surface;
use super::oriented::Oriented;
use super::placement::Placement;
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Slot, Workspace};

/// Initial width of the weights in the rough refinement, relative to the size of the smaller surface.
const ROUGH_WIDTH: f64 = 0.1;
/// Factor of the width per step.
const ROUGH_SHRINK: f64 = 0.8;
/// Number of steps of the rough refinement.
const ROUGH_STEPS: usize = 12;
/// Initial width in the fine refinement.
const FINE_WIDTH: f64 = 0.03;
/// Largest number of its steps, and of those of the last refinement.
const FINE_STEPS: usize = 60;
/// Smallest width: it must stay positive if residuals vanish.
const LEAST_WIDTH: f64 = 1e-7;
/// Width as a multiple of the standard deviation of the residuals.
const SPREADS: f64 = 4.0;
/// Ratio of the standard deviation to the median absolute value for a normal distribution.
const MEDIAN_TO_DEVIATION: f64 = 1.482_6;
/// Damping of the equations, relative to their mean diagonal entry: keeps those of a sphere or a plane solvable.
const DAMPING: f64 = 1e-9;
/// Largest rotation of a step, in radians.
const MOST_TURN: f64 = 0.5;
/// Converged if a step moves points by less than this fraction of the size.
const REST: f64 = 1e-13;

/// The position of a point and its nearest point on the fixed surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    p: DVec3,
    q: DVec3,
    normal: DVec3,
    pub(super) distance: f64,
    /// Whether the two surfaces have the same orientation there.
    facing: bool,
}

/// Refinement of a pose.
pub(super) struct Refinement<'s> {
    surface: &'s Surface,
    points: &'s [Oriented],
    /// The centre of rotation, before the placement.
    centre: DVec3,
    /// The least and the greatest scale; equal if the scale is fixed.
    scales: [f64; 2],
    /// Size of the smaller surface.
    size: f64,
    slots: Vec<Slot>,
    matches: Vec<Match>,
    workspace: Workspace,
}

impl<'s> Refinement<'s> {
    pub(super) fn new(
        surface: &'s Surface,
        points: &'s [Oriented],
        centre: DVec3,
        scales: [f64; 2],
        size: f64,
    ) -> Self {
        Self {
            surface,
            points,
            centre,
            scales,
            size,
            slots: vec![surface.any_slot(); points.len()],
            matches: Vec::with_capacity(points.len()),
            workspace: Workspace::default(),
        }
    }

    /// A pose accurate enough to separate good starts from bad ones.
    pub(super) fn rough(&mut self, start: Placement) -> Placement {
        let mut placement = start;
        let mut width = ROUGH_WIDTH * self.size;
        for _ in 0..ROUGH_STEPS {
            self.look(&placement);
            let Some((next, _)) = self.step(&placement, |found| geman_mcclure(found, width)) else { break };
            placement = next;
            width *= ROUGH_SHRINK;
        }
        placement
    }

    /// The local optimum, with weights that narrow to the spread of the residuals.
    pub(super) fn fine(&mut self, start: Placement) -> Placement {
        let mut placement = start;
        let mut width = FINE_WIDTH * self.size;
        for _ in 0..FINE_STEPS {
            self.look(&placement);
            let Some((next, moved)) = self.step(&placement, |found| geman_mcclure(found, width)) else {
                break;
            };
            placement = next;
            let least = self.reach(3.0 * width);
            let narrower = (0.5 * width).max(least);
            if moved < REST * self.size && narrower >= width {
                break;
            }
            width = narrower.min(width);
        }
        placement
    }

    /// Least squares over the nearest share of the points or, without a share, over those within the spread of the residuals; and
    /// the greatest distance of these points. Leaves the matches of the final pose.
    pub(super) fn last(&mut self, start: Placement, share: Option<f64>) -> (Placement, f64) {
        let mut placement = start;
        self.look(&placement);
        let spread = self.reach(FINE_WIDTH * self.size);
        let within = |found: &Self| share.map_or(spread, |share| found.quantile(share));
        for _ in 0..FINE_STEPS {
            let reach = within(self);
            let inside = |found: &Match| f64::from(u8::from(found.distance <= reach));
            let Some((next, moved)) = self.step(&placement, inside) else { break };
            placement = next;
            self.look(&placement);
            if moved < REST * self.size {
                break;
            }
        }
        (placement, within(self))
    }

    /// Computes the nearest points.
    pub(super) fn look(&mut self, placement: &Placement) {
        self.matches.clear();
        for (point, slot) in self.points.iter().zip(&mut self.slots) {
            let p = placement.apply(point.point);
            let (q, normal) = self.surface.nearest(p, slot, &mut self.workspace);
            let facing = normal.dot(placement.pose.rotation * point.normal) > 0.0;
            self.matches.push(Match { p, q, normal, distance: p.distance(q), facing });
        }
    }

    pub(super) fn matches(&self) -> &[Match] {
        &self.matches
    }

    /// The score of a pose: 1 if all points lie on the surface with the same orientation, 0 if none is closer than `width`.
    pub(super) fn score(&self, width: f64) -> f64 {
        let fit = |found: &Match| {
            let share = found.distance / width;
            if found.facing { (1.0 - share * share).max(0.0) } else { 0.0 }
        };
        self.matches.iter().map(fit).sum::<f64>() / self.matches.len() as f64
    }

    /// The reach of matched points: a multiple of the spread of point-to-plane distances below `below`.
    pub(super) fn reach(&self, below: f64) -> f64 {
        let near = self.matches.iter().filter(|found| found.facing && found.distance < below);
        let mut residuals: Vec<f64> = near.map(|found| found.normal.dot(found.p - found.q).abs()).collect();
        let middle = residuals.len() / 2;
        let median = if residuals.is_empty() {
            below
        } else {
            *residuals.select_nth_unstable_by(middle, f64::total_cmp).1
        };
        (SPREADS * MEDIAN_TO_DEVIATION * median).max(LEAST_WIDTH * self.size)
    }

    fn quantile(&self, share: f64) -> f64 {
        let mut distances: Vec<f64> = self.matches.iter().map(|found| found.distance).collect();
        let place = ((share * distances.len() as f64).ceil() as usize).clamp(1, distances.len()) - 1;
        *distances.select_nth_unstable_by(place, f64::total_cmp).1
    }

    /// A Gauss–Newton step, and how far it moves points; `None` if all weights are zero or numbers overflow.
    fn step(&self, placement: &Placement, weight: impl Fn(&Match) -> f64) -> Option<(Placement, f64)> {
        let about = placement.apply(self.centre);
        let (equations, _) = self.equations(about, weight)?;
        let x = equations.solved(DAMPING)?;
        let [mut turn, mut shift] = [DVec3::from_slice(&x[..3]), DVec3::from_slice(&x[3..6])];
        let mut growth = x[6];
        let shorter = (MOST_TURN / turn.length()).min(MOST_TURN / growth.abs()).min(1.0);
        (turn, shift, growth) = (turn * shorter, shift * shorter, growth * shorter);
        let moved = shift.length() + (turn.length() + growth.abs()) * self.size;
        let [least, most] = self.scales;
        let factor = (placement.scale * libm::exp(growth)).clamp(least, most) / placement.scale;
        Some((placement.then(factor, turn, about, shift), moved))
    }

    /// Equations for a rotation and a scaling about a point and a translation, and the sum of the weighted squared residuals;
    /// `None` if all weights are zero.
    fn equations(&self, about: DVec3, weight: impl Fn(&Match) -> f64) -> Option<(Equations<7>, f64)> {
        let mut equations = Equations::<7>::new();
        let (mut used, mut sum) = (0, 0.0);
        for found in &self.matches {
            let weight = weight(found);
            if weight > 0.0 {
                let (arm, n) = (found.p - about, found.normal);
                let turn = arm.cross(n);
                let growth = if self.has_scale() { arm.dot(n) } else { 0.0 };
                let off = n.dot(found.q - found.p);
                equations.add(weight, [turn.x, turn.y, turn.z, n.x, n.y, n.z, growth], off);
                sum += weight * off * off;
                used += 1;
            }
        }
        if used == 0 {
            return None;
        }
        if !self.has_scale() {
            equations.add(1.0, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 0.0);
        }
        Some((equations, sum))
    }

    fn has_scale(&self) -> bool {
        self.scales[0] < self.scales[1]
    }

    /// One standard deviation of the scale at the pose of the last [`look`](Self::look), from the points within a distance. `None`
    /// if the scale is fixed, or the points do not determine it. The covariance of least squares is the inverse of the normal
    /// matrix times the variance of the residuals.
    pub(super) fn scale_deviation(&self, placement: &Placement, within: f64) -> Option<f64> {
        let inside = |found: &Match| f64::from(u8::from(found.distance <= within));
        let count = self.matches.iter().map(inside).sum::<f64>();
        if !self.has_scale() || count <= 7.0 {
            return None;
        }
        let (equations, sum) = self.equations(placement.apply(self.centre), inside)?;
        let variance = equations.inverse_column::<6>()?[6] * sum / (count - 7.0);
        (variance >= 0.0).then(|| placement.scale * variance.sqrt())
    }

    /// Root mean square of the distances below `within`, relative to it.
    pub(super) fn spread(&self, within: f64) -> f64 {
        let shares = self.matches.iter().map(|found| found.distance / within).filter(|share| *share <= 1.0);
        let (count, sum) =
            shares.fold((0_usize, 0.0), |(count, sum), share| (count + 1, sum + share * share));
        if count == 0 { 1.0 } else { (sum / count as f64).sqrt() }
    }
}

/// The Geman–`McClure` weight: it decays with the fourth power of distance, so that points without a counterpart have little
/// influence.
fn geman_mcclure(found: &Match, width: f64) -> f64 {
    let share = found.distance / width;
    let weight = 1.0 / (1.0 + share * share);
    if found.facing { weight * weight } else { 0.0 }
}
