//! Closest points under weights that let go of what has no counterpart.

use super::super::equations::Equations;
use super::super::registration::Surface;
use super::oriented::Oriented;
use super::placement::Placement;
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Slot, Workspace};

/// Widths of the weights are fractions of the size of the smaller surface. Those of the rough descent, first to last:
const ROUGH_WIDTH: f64 = 0.1;
/// By what they shrink at each step.
const ROUGH_SHRINK: f64 = 0.8;
/// Steps of the rough descent.
const ROUGH_STEPS: usize = 12;
/// The first width of the fine descent.
const FINE_WIDTH: f64 = 0.03;
/// Most steps of it, and of the last one.
const FINE_STEPS: usize = 60;
/// The least width: where residuals vanish, a width must not.
const LEAST_WIDTH: f64 = 1e-7;
/// The width in spreads of the residuals.
const SPREADS: f64 = 4.0;
/// Standard deviations in a median of absolute values of a normal distribution.
const MEDIAN_TO_DEVIATION: f64 = 1.482_6;
/// Damping of the equations, as a share of their mean diagonal entry: keeps those of a sphere or a plane solvable.
const DAMPING: f64 = 1e-9;
/// Largest turn of a step, in radians.
const MOST_TURN: f64 = 0.5;
/// A step that moves points by less than this fraction of the size is the last.
const REST: f64 = 1e-13;

/// Where a point lies and what it is nearest to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    p: DVec3,
    q: DVec3,
    normal: DVec3,
    pub(super) distance: f64,
    /// Whether both surfaces face the same way there.
    facing: bool,
}

/// A descent from one place.
pub(super) struct Refinement<'s> {
    surface: &'s Surface,
    points: &'s [Oriented],
    /// What turns are about, before the placement.
    centre: DVec3,
    /// The least and the greatest scale; equal where it is given.
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

    /// A place near enough to tell good starts from bad ones.
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

    /// The local optimum, as weights narrow to the spread of the residuals.
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

    /// Least squares over a share of the points, the nearest, or without one over those within the spread of the residuals; and the
    /// greatest distance of those points. It leaves the matches of the place where it ends.
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

    /// Asks for the nearest points.
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

    /// How well a place fits: 1 where all points lie on the surface and face its way, 0 where none is as near as `width`.
    pub(super) fn score(&self, width: f64) -> f64 {
        let fit = |found: &Match| {
            let share = found.distance / width;
            if found.facing { (1.0 - share * share).max(0.0) } else { 0.0 }
        };
        self.matches.iter().map(fit).sum::<f64>() / self.matches.len() as f64
    }

    /// How far matched points may be: spreads of the distances from the planes of what is nearer than `below`.
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

    /// A step of Gauss and Newton, and how far it moves points; none where nothing has weight or numbers left their range.
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

    /// Equations for a turn and a growth about a point and a shift, and the sum of the weighted squares of what they are to make up for;
    /// none where nothing has weight.
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

    /// One standard deviation of the scale at a place that was [looked](Self::look) at, from the points within a distance; none where it
    /// is given, or the points leave it free. The covariance of least squares is the inverse of their equations times the variance of
    /// what is left.
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

    /// Root mean square distance of what is within a distance, as a share of it.
    pub(super) fn spread(&self, within: f64) -> f64 {
        let shares = self.matches.iter().map(|found| found.distance / within).filter(|share| *share <= 1.0);
        let (count, sum) =
            shares.fold((0_usize, 0.0), |(count, sum), share| (count + 1, sum + share * share));
        if count == 0 { 1.0 } else { (sum / count as f64).sqrt() }
    }
}

/// The Geman–`McClure` weight: falls with the fourth power of distance, so that what has no counterpart does not pull.
fn geman_mcclure(found: &Match, width: f64) -> f64 {
    let share = found.distance / width;
    let weight = 1.0 / (1.0 + share * share);
    if found.facing { weight * weight } else { 0.0 }
}
