//! Where a skeleton is hard to mesh: branches that turn too sharply or are too short, and nodes.

use super::build::{area_factor, arranged};
use super::cluster::Cluster;
use super::layout::Layout;
use super::tube::{End, Tube};
use crate::Skeleton;
use std::collections::BTreeMap;

/// What makes the neighbourhood of a sample hard to mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cause {
    /// The tube between two samples turns too sharply for its sections: its axis is moved by so many radii.
    Turn { ends: [usize; 2], moved: f64 },
    /// The tube between two samples, of this length, has no room beside its node, and is left out.
    LeftOut { ends: [usize; 2], length: f64 },
    /// The node at a sample, with so many branches; the least angle between two of them, in degrees, if there are two.
    Node { sample: usize, arms: usize, angle: Option<f64> },
}

/// The tubes and nodes of a mesh, by samples.
pub(crate) struct Causes {
    tubes: Vec<Tube>,
    layout: Layout,
    /// For each sample the tubes that it lies on, and its length along each from the first end, up to the last.
    places: BTreeMap<usize, Vec<(usize, [f64; 2])>>,
    radii: Vec<f64>,
}

impl Causes {
    /// Those of a mesh with so many parts of each block along each edge.
    pub(crate) fn new(skeleton: &Skeleton, parts: usize) -> Self {
        let (tubes, layout, _) = arranged(skeleton, area_factor(4 * parts));
        let samples = skeleton.samples();
        let mut places: BTreeMap<usize, Vec<(usize, [f64; 2])>> = BTreeMap::new();
        for (index, tube) in tubes.iter().enumerate() {
            let mut lengths = vec![0.0];
            for pair in tube.samples.windows(2) {
                let [a, b] = [pair[0], pair[1]].map(|sample| samples[sample].position);
                lengths.push(lengths[lengths.len() - 1] + a.distance(b));
            }
            let total = lengths[lengths.len() - 1];
            for (&sample, &at) in tube.samples.iter().zip(&lengths) {
                places.entry(sample).or_default().push((index, [at, total - at]));
            }
        }
        Self { tubes, layout, places, radii: samples.iter().map(|sample| sample.radius).collect() }
    }

    /// What makes a sample hard to mesh; `None` on a tube that is followed, away from nodes.
    pub(crate) fn at(&self, sample: usize) -> Option<Cause> {
        let places = self.places.get(&sample).map_or(&[][..], Vec::as_slice);
        let left_out = places.iter().find(|(tube, _)| self.layout.dropped.contains(tube));
        if let Some(&(tube, _)) = left_out {
            let Tube { nodes: ends, .. } = self.tubes[tube];
            return Some(Cause::LeftOut { ends, length: self.tubes[tube].length() });
        }
        let moved = |&&(tube, _): &&(usize, _)| self.tubes[tube].moved > 0.0;
        if let Some(&(tube, _)) = places.iter().find(moved) {
            let Tube { nodes: ends, moved, .. } = self.tubes[tube];
            return Some(Cause::Turn { ends, moved });
        }
        self.node_at(sample)
    }

    /// The node whose mesh contains a sample.
    pub(crate) fn node_at(&self, sample: usize) -> Option<Cause> {
        let places = self.places.get(&sample).map_or(&[][..], Vec::as_slice);
        let pairs = self.layout.clusters.iter().zip(&self.layout.reach);
        let (cluster, reach) =
            pairs.into_iter().find(|(cluster, reach)| self.is_in(cluster, reach, sample, places))?;
        let node = cluster.samples[0];
        Some(Cause::Node { sample: node, arms: cluster.ends.len(), angle: self.least_angle(cluster, reach) })
    }

    /// Whether a sample lies within a radius of the mesh of a node.
    fn is_in(&self, cluster: &Cluster, reach: &[f64], sample: usize, places: &[(usize, [f64; 2])]) -> bool {
        let on_arm = |&(tube, [from_first, from_last]): &(usize, [f64; 2])| {
            cluster.ends.iter().zip(reach).any(|(end, reach)| {
                let along = if end.first { from_first } else { from_last };
                end.tube == tube && along <= reach + self.radii[sample]
            })
        };
        let is_inside = |(tube, _): &(usize, _)| cluster.inside.contains(tube);
        cluster.samples.contains(&sample) || places.iter().any(|place| is_inside(place) || on_arm(place))
    }

    /// The least angle between two branches of a node in degrees.
    fn least_angle(&self, cluster: &Cluster, reach: &[f64]) -> Option<f64> {
        let ends = cluster.ends.iter().zip(reach);
        let way = |(end, &s): (&End, &f64)| end.at(&self.tubes, s).0 - cluster.centre;
        let ways: Vec<_> = ends.map(way).collect();
        let mut least: Option<f64> = None;
        for (k, a) in ways.iter().enumerate() {
            for b in &ways[..k] {
                let angle = a.angle_between(*b).to_degrees();
                least = Some(least.map_or(angle, |least| least.min(angle)));
            }
        }
        least
    }
}
