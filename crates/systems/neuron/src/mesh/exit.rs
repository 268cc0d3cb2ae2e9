//! Where a thin tube leaves a thick one, away from their node.

use super::cluster::{Cluster, THIN};
use super::tube::{End, Tube};
use glam::DVec3;

/// An arm and the length that it should have if there is room: the core may lie where a thin tube leaves a thick one.
pub(super) fn longer_arm(cluster: &Cluster, tubes: &[Tube], reach: &[f64]) -> Option<(usize, f64)> {
    let Exit { tube, along, radius, .. } = exit(cluster, tubes, reach)?;
    let s = cluster.ends[tube].beside_corners(tubes, along + BESIDE_CORE * radius);
    (s > reach[tube]).then_some((tube, s))
}

/// Distance from the node, over the radius, from which on the place where a thin tube leaves a thick one is another one.
const AWAY: f64 = 0.5;

/// Steps along a tube in which the end of its part within another one is sought.
const EXIT_STEPS: usize = 50;

/// Length of a thick tube beside a core, in radii.
const BESIDE_CORE: f64 = 0.85;

/// The place on the axis of a thick tube next to which a thin one leaves it.
#[derive(Clone, Copy)]
pub(super) struct Exit {
    pub(super) centre: DVec3,
    /// The thick tube, the length from the node along it, and its radius.
    tube: usize,
    along: f64,
    radius: f64,
}

/// The place where a thin tube leaves a thick one, if that is away from the node: there the thin one leaves it sideways, whatever their angle is.
/// The farthest such place if there are several.
pub(super) fn exit(cluster: &Cluster, tubes: &[Tube], reach: &[f64]) -> Option<Exit> {
    if !cluster.balls.is_empty() {
        return None;
    }
    let place = |length: f64, k: usize| length * k as f64 / EXIT_STEPS as f64;
    let ends = || cluster.ends.iter().zip(reach).enumerate();
    let ball = |(tube, (end, &length)): (usize, (&End, &f64)), k: usize| {
        let along = place(length, k);
        let (centre, radius) = end.at(tubes, along);
        Exit { centre, tube, along, radius }
    };
    let balls: Vec<Exit> = ends().flat_map(|end| (0..=EXIT_STEPS).map(move |k| ball(end, k))).collect();
    let mut farthest: Option<Exit> = None;
    for (index, (end, &length)) in ends() {
        let thin = end.at(tubes, length).1;
        let thick = || balls.iter().filter(|ball| ball.tube != index && thin <= THIN * ball.radius);
        // The ball that contains a point of the axis deepest.
        let around = |k: usize| {
            let p = end.at(tubes, place(length, k)).0;
            let depths = thick().map(|ball| (ball.radius - p.distance(ball.centre), ball));
            let deepest = depths.max_by(|a, b| a.0.total_cmp(&b.0));
            deepest.filter(|(depth, _)| *depth >= 0.0).map(|(_, ball)| *ball)
        };
        if thick().next().is_none() {
            continue;
        }
        let Some(exit) = (0..EXIT_STEPS).rev().find_map(around) else { continue };
        let away = |exit: &Exit| exit.along / exit.radius;
        if away(&exit) > AWAY && farthest.is_none_or(|other| away(&exit) > away(&other)) {
            farthest = Some(exit);
        }
    }
    farthest
}
