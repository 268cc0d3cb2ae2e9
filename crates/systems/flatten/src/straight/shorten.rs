//! Straightening paths along the edges of a triangulation by edge flips.

use super::net::{Net, next};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::{EdgeData, SurfaceMesh};
use std::f64::consts::PI;

/// An angle beside a path counts as less than π if it is below π minus this: far more than rounding.
const STRAIGHT: f64 = 1e-6;

/// Largest number of rounds over all paths; a few are usual.
const MOST_ROUNDS: usize = 1000;

/// Paths that meet only at their ends.
pub(super) struct Network {
    /// Names of half-edges, in order.
    pub(super) paths: Vec<Vec<u32>>,
    /// Whether a half-edge, or its twin, is on a path.
    is_used: Vec<bool>,
    /// Whether a vertex is on a path or on the boundary.
    is_taken: VertexData<bool>,
}

impl Network {
    /// The paths of a cut between its ends, its branches and the boundary.
    pub(super) fn new(mesh: &SurfaceMesh, cut: &EdgeData<bool>) -> Self {
        let is_cut = |&h: &_| cut[mesh.edge(h)] && !mesh.is_boundary_edge(mesh.edge(h));
        let mut degree = VertexData::filled(mesh.vertices(), 0_u32);
        let mut is_taken = VertexData::from_fn(mesh.vertices(), |v| mesh.is_boundary_vertex(v));
        for v in mesh.vertex_ids() {
            degree[v] = mesh.outgoing(v).filter(is_cut).count() as u32;
            is_taken[v] |= degree[v] > 0;
        }
        let is_node = |v: VertexId| mesh.is_boundary_vertex(v) || degree[v] != 2;
        let mut is_used = vec![false; mesh.halfedges()];
        let mut paths = Vec::new();
        // Loops without a node start anywhere.
        let nodes =
            mesh.vertex_ids().filter(|&v| is_node(v)).chain(mesh.vertex_ids().filter(|&v| !is_node(v)));
        for node in nodes {
            for first in mesh.outgoing(node).filter(is_cut) {
                let mut path = Vec::new();
                let mut at = Some(first).filter(|h| !is_used[h.index()]);
                while let Some(h) = at {
                    path.push(h.0);
                    for side in [Some(h), mesh.twin(h)].into_iter().flatten() {
                        is_used[side.index()] = true;
                    }
                    let end = mesh.head(h);
                    let goes_on = !is_node(end) && end != node;
                    at = mesh.outgoing(end).filter(is_cut).find(|h| goes_on && !is_used[h.index()]);
                }
                if !path.is_empty() {
                    paths.push(path);
                }
            }
        }
        Self { paths, is_used, is_taken }
    }

    /// Shortens all paths until no angle beside them is less than π, except where they would touch each other or the boundary.
    ///
    /// # Source
    /// `sharp_you_2020`; paths that would touch stay as they are.
    pub(super) fn shorten(&mut self, net: &mut Net) {
        for _ in 0..MOST_ROUNDS {
            let mut is_changed = false;
            for p in 0..self.paths.len() {
                let mut i = 0;
                while i + 1 < self.paths[p].len() {
                    if self.cut_corner(net, p, i) {
                        is_changed = true;
                        i = i.saturating_sub(1);
                    } else {
                        i += 1;
                    }
                }
            }
            if !is_changed {
                break;
            }
        }
    }

    /// Moves a path past the vertex between two of its edges, on the side where the angle is less than π.
    fn cut_corner(&mut self, net: &mut Net, path: usize, i: usize) -> bool {
        let [before, after] = [i, i + 1].map(|i| self.paths[path][i]);
        let back = |net: &Net, name: u32| net.twin(net.slot(name)).map(|twin| net.name(twin));
        let Some(before_back) = back(net, before) else { return false };
        let corner = net.tail(net.slot(after));
        // To the left of the path: counter-clockwise from the outgoing to the incoming edge. To the right: the other way.
        for (from, to, is_left) in [(after, before_back, true), (before_back, after, false)] {
            let Some(arc) = self.arc(net, from, to) else { continue };
            let names: Option<Vec<u32>> =
                if is_left { arc.iter().rev().map(|&name| back(net, name)).collect() } else { Some(arc) };
            let Some(names) = names else { continue };
            for name in [before, after] {
                self.mark(net, name, false);
            }
            self.is_taken[corner] = false;
            for &name in &names {
                self.mark(net, name, true);
            }
            for &name in &names[1..] {
                self.is_taken[net.tail(net.slot(name))] = true;
            }
            self.paths[path].splice(i..i + 2, names);
            return true;
        }
        false
    }

    fn mark(&mut self, net: &Net, name: u32, is_used: bool) {
        self.is_used[name as usize] = is_used;
        if let Some(twin) = net.twin(net.slot(name)) {
            self.is_used[net.name(twin) as usize] = is_used;
        }
    }

    /// The path from the head of one half-edge to that of another with the same tail, counter-clockwise around it, after flipping
    /// away all edges between them that can be flipped. `None` unless it is shorter, unoccupied, and touches nothing.
    fn arc(&self, net: &mut Net, from: u32, to: u32) -> Option<Vec<u32>> {
        let wedge = |net: &Net| {
            let mut between = Vec::new();
            let mut angle = 0.0;
            let mut at = net.slot(from);
            loop {
                angle += net.angle(at);
                at = net.turned(at)?;
                if net.name(at) == to {
                    return Some((between, angle));
                }
                if self.is_used[net.name(at) as usize] || angle >= PI - STRAIGHT {
                    return None;
                }
                between.push(net.name(at));
            }
        };
        let (mut between, angle) = wedge(net)?;
        if angle >= PI - STRAIGHT {
            return None;
        }
        let is_bent = |net: &Net, name: u32| {
            net.angle_at_head(net.slot(name)).is_some_and(|angle| angle < PI - STRAIGHT)
        };
        while let Some(k) = between.iter().position(|&name| is_bent(net, name)) {
            if !net.flip(net.slot(between[k])) {
                return None;
            }
            between.remove(k);
        }
        let spokes = std::iter::once(from).chain(between.iter().copied());
        let arc: Vec<u32> = spokes.map(|name| net.name(next(net.slot(name)))).collect();
        let is_free =
            arc.iter().all(|&name| !self.is_used[name as usize] && net.twin(net.slot(name)).is_some());
        let mut inner: Vec<VertexId> = arc[1..].iter().map(|&name| net.tail(net.slot(name))).collect();
        let touches = inner.iter().any(|&v| self.is_taken[v]);
        inner.sort_unstable();
        let repeats = inner.windows(2).any(|pair| pair[0] == pair[1]);
        (is_free && !touches && !repeats).then_some(arc)
    }
}
