//! Leaving out branches at nodes whose cells stay folded, so that there is a mesh of the rest.

use super::cluster::Cluster;
use super::options::FoldedNode;
use super::tube::{End, Tube};
use std::collections::BTreeMap;

/// Tubes that are left out: for each one the node whose cells stay folded with it, or none if it lies beyond another one.
#[derive(Clone, Default)]
pub(super) struct Cut(BTreeMap<usize, Option<FoldedNode>>);

impl Cut {
    pub(super) fn contains(&self, tube: usize) -> bool {
        self.0.contains_key(&tube)
    }

    /// The node whose cells stay folded with a tube; `None` if the tube lies beyond another one that is left out.
    pub(super) fn node(&self, tube: usize) -> Option<FoldedNode> {
        self.0.get(&tube).copied().flatten()
    }

    /// Leaves out, at each of these nodes, the arm with the least volume, and all beyond it.
    pub(super) fn at_nodes(&self, tubes: &[Tube], nodes: &[(&Cluster, FoldedNode)]) -> Self {
        let mut found = self.clone();
        for (cluster, node) in nodes {
            let arms = cluster.ends.iter().filter(|end| !found.contains(end.tube));
            let beyond = arms.map(|end| (*end, beyond(tubes, *end)));
            let volume = |of: &[usize]| of.iter().map(|&tube| volume(&tubes[tube])).sum::<f64>();
            let least = beyond.min_by(|a, b| volume(&a.1).total_cmp(&volume(&b.1)));
            let Some((end, beyond)) = least else { continue };
            found.0.extend(beyond.into_iter().map(|tube| (tube, None)));
            found.0.insert(end.tube, Some(*node));
        }
        found
    }
}

/// A tube, and all tubes that a node reaches through it.
fn beyond(tubes: &[Tube], end: End) -> Vec<usize> {
    let mut found = vec![end.tube];
    let mut ends = vec![tubes[end.tube].nodes[usize::from(end.first)]];
    while let Some(node) = ends.pop() {
        for (index, tube) in tubes.iter().enumerate() {
            let Some(side) = tube.nodes.iter().position(|other| *other == node) else { continue };
            if !found.contains(&index) {
                found.push(index);
                ends.push(tube.nodes[1 - side]);
            }
        }
    }
    found
}

/// The volume of a tube, but for a factor.
fn volume(tube: &Tube) -> f64 {
    let cone = |cone: &crate::RoundCone| {
        let [a, b] = cone.radii;
        cone.ends[0].distance(cone.ends[1]) * (a * a + a * b + b * b)
    };
    tube.cones.iter().map(cone).sum()
}
