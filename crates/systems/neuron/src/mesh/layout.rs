//! Clusters of nodes that are meshed together, and tubes too short to be meshed.

use super::cluster::Cluster;
use super::cut::Cut;
use super::exit::longer_arm;
use super::tube::{End, Tube, is_ball};
use crate::Skeleton;
use glam::DVec3;
use std::collections::BTreeMap;

/// Smallest room between the two ends of a tube, in radii; with less, its nodes are meshed together.
const ROOM: f64 = 0.8;

/// The same where more than two nodes would be meshed together: long clusters have no place from which all of their wall is seen.
const LITTLE_ROOM: f64 = 0.05;

/// The clusters with the lengths of their arms, and the tubes between them.
pub(super) struct Layout {
    pub(super) clusters: Vec<Cluster>,
    pub(super) reach: Vec<Vec<f64>>,
    /// For each tube the start and end of its own mesh, with the cluster and arm there; `None` for a tube that is part of a cluster
    /// or omitted.
    pub(super) spans: Vec<Option<[Span; 2]>>,
    /// Omitted tubes.
    pub(super) dropped: Vec<usize>,
}

impl Layout {
    /// Whether nothing is meshed.
    pub(super) fn has_nothing(&self) -> bool {
        self.clusters.iter().all(|cluster| cluster.ends.is_empty()) && self.spans.iter().all(Option::is_none)
    }
}

/// One end of the mesh of a tube.
#[derive(Clone, Copy)]
pub(super) struct Span {
    /// Length from the tube's first end.
    pub(super) at: f64,
    /// The cluster and its arm; `None` at a tip.
    pub(super) arm: Option<(usize, usize)>,
}

/// Finds clusters: starts with one per node, merges those whose tubes have no room between them, and omits tips without room, until
/// nothing changes.
/// Tubes that are left out anyway are omitted from the beginning.
pub(super) fn layout(skeleton: &Skeleton, tubes: &[Tube], factor: f64, cut: &Cut) -> Layout {
    let mut ends: BTreeMap<usize, usize> = BTreeMap::new();
    for tube in tubes {
        tube.nodes.iter().for_each(|&node| *ends.entry(node).or_default() += 1);
    }
    let nodes: Vec<usize> = ends
        .iter()
        .filter(|&(&node, &count)| count > 1 || is_ball(skeleton, node))
        .map(|(&node, _)| node)
        .collect();
    let is_tip = |end: End| ends[&tubes[end.tube].nodes[usize::from(end.first)]] == 1;
    let mut leader: BTreeMap<usize, usize> = nodes.iter().map(|&node| (node, node)).collect();
    let mut dropped: Vec<bool> = (0..tubes.len()).map(|tube| cut.contains(tube)).collect();
    loop {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (&node, &to) in &leader {
            members.entry(to).or_default().push(node);
        }
        let clusters: Vec<Cluster> = members
            .into_values()
            .map(|samples| cluster(skeleton, tubes, factor, &leader, &dropped, samples))
            .collect();
        let found: Vec<Vec<Option<f64>>> =
            clusters.iter().map(|cluster| cluster.clearances(tubes, is_tip)).collect();
        let mut arm_of: BTreeMap<(usize, bool), (usize, usize)> = BTreeMap::new();
        for (c, cluster) in clusters.iter().enumerate() {
            for (a, end) in cluster.ends.iter().enumerate() {
                arm_of.insert((end.tube, end.first), (c, a));
            }
        }
        let mut changed = false;
        // For each cluster the shortest tip without room: beside it, longer ones may have some.
        let mut shortest: BTreeMap<usize, usize> = BTreeMap::new();
        // Clusters without room between them, with this room over the radius.
        let mut close: Vec<(f64, [usize; 2])> = Vec::new();
        for (index, tube) in tubes.iter().enumerate() {
            let arms = [true, false].map(|first| arm_of.get(&(index, first)).copied());
            let room = tube.length()
                - arms.iter().flatten().map(|&(c, a)| found[c][a].unwrap_or(f64::INFINITY)).sum::<f64>();
            let radius = tube.at(0.5 * tube.length()).1;
            match arms {
                [Some((a, _)), Some((b, _))] if a != b => {
                    let nodes = clusters[a].samples.len() + clusters[b].samples.len();
                    if room < radius * if nodes > 2 { LITTLE_ROOM } else { ROOM } {
                        close.push((room / radius, [a, b]));
                    }
                }
                [Some((c, _)), None] | [None, Some((c, _))] if room < 0.0 => {
                    let least = shortest.entry(c).or_insert(index);
                    if tube.length() < tubes[*least].length() {
                        *least = index;
                    }
                    changed = true;
                }
                // All samples of the tube lie at one place.
                [None, None] if tube.length() <= 0.0 && !dropped[index] => {
                    dropped[index] = true;
                    changed = true;
                }
                _ => (),
            }
        }
        for index in shortest.into_values() {
            dropped[index] = true;
        }
        changed |= merge(close, &clusters, &mut leader);
        if changed {
            continue;
        }
        let mut reach: Vec<Vec<f64>> =
            found.into_iter().map(|of| of.into_iter().map(|s| s.unwrap_or(0.0)).collect()).collect();
        for c in 0..clusters.len() {
            let Some((arm, s)) = longer_arm(&clusters[c], tubes, &reach[c]) else { continue };
            let end = clusters[c].ends[arm];
            let tube = &tubes[end.tube];
            let other = arm_of.get(&(end.tube, !end.first)).map_or(0.0, |&(c, a)| reach[c][a]);
            if tube.length() - s - other >= ROOM * tube.at(0.5 * tube.length()).1 {
                reach[c][arm] = s;
            }
        }
        let spans = tubes
            .iter()
            .enumerate()
            .map(|(index, tube)| {
                let inside = tube.nodes.iter().all(|node| leader.contains_key(node))
                    && leader[&tube.nodes[0]] == leader[&tube.nodes[1]];
                if dropped[index] || inside {
                    return None;
                }
                Some([true, false].map(|first| {
                    let arm = arm_of.get(&(index, first)).copied();
                    let s = arm.map_or(0.0, |(c, a): (usize, usize)| reach[c][a]);
                    Span { at: if first { s } else { tube.length() - s }, arm }
                }))
            })
            .collect();
        let dropped = (0..tubes.len()).filter(|&t| dropped[t]).collect();
        return Layout { clusters, reach, spans, dropped };
    }
}

/// Merges pairs of clusters, those with the least room first, each cluster at most once; returns whether there are any.
fn merge(
    mut close: Vec<(f64, [usize; 2])>,
    clusters: &[Cluster],
    leader: &mut BTreeMap<usize, usize>,
) -> bool {
    close.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut is_merged = vec![false; clusters.len()];
    for (_, pair) in &close {
        if pair.iter().any(|c| is_merged[*c]) {
            continue;
        }
        for c in pair {
            is_merged[*c] = true;
        }
        let [to, from] = pair.map(|c| leader[&clusters[c].samples[0]]);
        leader.values_mut().filter(|l| **l == from).for_each(|l| *l = to);
    }
    !close.is_empty()
}

fn cluster(
    skeleton: &Skeleton,
    tubes: &[Tube],
    factor: f64,
    leader: &BTreeMap<usize, usize>,
    dropped: &[bool],
    samples: Vec<usize>,
) -> Cluster {
    let of = leader[&samples[0]];
    let (mut ends, mut inside) = (Vec::new(), Vec::new());
    for (index, tube) in tubes.iter().enumerate().filter(|(index, _)| !dropped[*index]) {
        match tube.nodes.map(|node| leader.get(&node) == Some(&of)) {
            [true, true] => inside.push(index),
            [true, false] => ends.push(End { tube: index, first: true }),
            [false, true] => ends.push(End { tube: index, first: false }),
            [false, false] => (),
        }
    }
    let all = skeleton.samples();
    let balls: Vec<(DVec3, f64)> = samples
        .iter()
        .filter(|&&s| is_ball(skeleton, s))
        .map(|&s| (all[s].position, all[s].radius))
        .collect();
    let centre = match balls.first() {
        Some(&(centre, _)) => centre,
        None => samples.iter().map(|&s| all[s].position).sum::<DVec3>() / samples.len() as f64,
    };
    let radius = match balls.first() {
        Some(&(_, radius)) => radius,
        None => factor * samples.iter().map(|&s| all[s].radius).sum::<f64>() / samples.len() as f64,
    };
    Cluster { samples, ends, inside, balls, centre, radius }
}
