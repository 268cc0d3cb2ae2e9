//! A node, or several that are meshed together: the room that sections at the ends of its arms need, and its wall.

use super::tube::{End, Tube};
use super::wall::Wall;
use crate::RoundCone;
use glam::DVec3;

/// A node, or several that are too close for tubes between them.
pub(super) struct Cluster {
    /// The samples.
    pub(super) samples: Vec<usize>,
    /// The tubes that leave it.
    pub(super) ends: Vec<End>,
    /// The tubes between its nodes.
    pub(super) inside: Vec<usize>,
    /// Its somata: centre and radius.
    pub(super) balls: Vec<(DVec3, f64)>,
    pub(super) centre: DVec3,
    /// Mean radius of the tubes at the node.
    pub(super) radius: f64,
}

/// Distance of the ring of a section from all other tubes, in radii.
const CLEAR: f64 = 0.15;

/// The same at a tip that has no room for more.
const CLEAR_AT_TIP: f64 = 0.03;

/// Smallest room between a node and the tip of a tube, in radii; with less, the tube is omitted.
const TIP_ROOM: f64 = 0.1;

/// Width of the blend of the wall, over the least radius of the arms.
const BLEND: f64 = 0.05;

/// Depth inside a ball from which on a cone is not part of the wall, in widths of the blend: it would change the wall by e⁻²⁰.
const DEEP: f64 = 20.0;

/// Number of points checked on a ring.
const RING: usize = 12;

impl Cluster {
    /// For each end the length along its tube at which the mesh of the node ends; `None` if the tube is too short.
    pub(super) fn clearances(&self, tubes: &[Tube], is_tip: impl Fn(End) -> bool) -> Vec<Option<f64>> {
        let least = |end: End, clear: f64, room: f64| {
            let s = end.beside_corners(tubes, self.clearance(tubes, end, clear)?);
            Some(s).filter(|s| s + room <= tubes[end.tube].length())
        };
        let clearance = |&end: &End| {
            if !is_tip(end) {
                return least(end, CLEAR, 0.0);
            }
            let room = TIP_ROOM * end.at(tubes, tubes[end.tube].length()).1;
            least(end, CLEAR, room).or_else(|| least(end, CLEAR_AT_TIP, room))
        };
        self.ends.iter().map(clearance).collect()
    }

    /// The least length along a tube from which on sections are clear of all other tubes for a radius, or to its end.
    fn clearance(&self, tubes: &[Tube], end: End, clear: f64) -> Option<f64> {
        let length = tubes[end.tube].length();
        let (mut s, mut since) = (0.0, None);
        // No section lies within the ball of the tube's own node.
        let least = 0.8 * end.at(tubes, 0.0).1;
        while s <= length {
            let radius = end.at(tubes, s).1;
            let is_clear = s >= least && self.is_clear(tubes, end, s, clear);
            match (is_clear, since) {
                (false, _) => since = None,
                (true, None) => since = Some(s),
                (true, Some(first)) if s >= first + radius => return since,
                _ => (),
            }
            s += 0.1 * radius;
        }
        since
    }

    fn is_clear(&self, tubes: &[Tube], end: End, s: f64, clear: f64) -> bool {
        let (centre, radius) = end.section(tubes, s);
        let axis = end.tangent(tubes, s);
        let (e1, e2) = axis.any_orthonormal_pair();
        let reach = s + 4.0 * self.radius + 2.0 * radius;
        let inside = self.inside.iter().flat_map(|&tube| tubes[tube].cones.iter());
        let others = self
            .ends
            .iter()
            .filter(|other| other.tube != end.tube || other.first != end.first)
            .flat_map(|other| other.cones(tubes, reach.min(tubes[other.tube].length())))
            .chain(inside);
        let near: Vec<&RoundCone> = others
            .filter(|cone| {
                let (low, high) = (cone.bounds()[0], cone.bounds()[1]);
                centre.distance(centre.clamp(low, high)) <= (1.0 + clear) * radius
            })
            .collect();
        let ring = (0..RING).map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / RING as f64;
            centre + (e1 * libm::cos(angle) + e2 * libm::sin(angle)) * radius
        });
        ring.chain([centre]).all(|p| {
            near.iter().all(|cone| cone.distance(p).0 >= clear * radius)
                && self.balls.iter().all(|(c, r)| p.distance(*c) - r >= clear * radius)
        })
    }

    /// Whether cells are much smaller than the cluster: on a ball, and at tubes that are thin beside its depth.
    pub(super) fn has_small_cells(&self, tubes: &[Tube], reach: &[f64], depth: f64) -> bool {
        let thinnest = self.ends.iter().zip(reach).map(|(end, s)| end.at(tubes, *s).1);
        self.balls.len() == 1 || thinnest.fold(f64::INFINITY, f64::min) <= THIN * depth
    }

    /// The wall around the cluster.
    pub(super) fn wall(&self, tubes: &[Tube], reach: &[f64]) -> Wall {
        let mut groups: Vec<Vec<RoundCone>> = self
            .ends
            .iter()
            .zip(reach)
            .map(|(end, s)| {
                let within = s + 3.0 * end.at(tubes, *s).1;
                end.cones(tubes, within.min(tubes[end.tube].length())).to_vec()
            })
            .collect();
        groups.extend(self.inside.iter().map(|&tube| tubes[tube].cones.clone()));
        let least =
            self.ends.iter().zip(reach).map(|(end, s)| end.at(tubes, *s).1).fold(f64::INFINITY, f64::min);
        let blend = BLEND * least;
        // Deep inside a ball, cones do not change the wall.
        let is_deep = |cone: &RoundCone| {
            let in_ball = |(c, r): &(DVec3, f64)| {
                (0..2).all(|k| cone.ends[k].distance(*c) + cone.radii[k] < r - DEEP * blend)
            };
            self.balls.iter().any(in_ball)
        };
        for group in &mut groups {
            group.retain(|cone| !is_deep(cone));
        }
        groups.retain(|group| !group.is_empty());
        groups.extend(self.balls.iter().map(|&(c, r)| vec![RoundCone { ends: [c, c], radii: [r, r] }]));
        Wall::new(groups, blend)
    }
}

/// A tube is thin beside another one if its radius is at most this share of it.
pub(super) const THIN: f64 = 0.6;
