//! Arcs: the pieces of seams between places where they meet or end.

use super::layout::Layout;
use pompeiu_core::VertexId;
use pompeiu_surface::EdgeId;

/// Shares of an arc with a free end that may be closed.
const SHARES: [f64; 3] = [0.25, 0.5, 1.0];

/// A path of seam edges whose inner vertices no other seam meets.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    pub(super) edges: Vec<EdgeId>,
    pub(super) ends: [VertexId; 2],
    /// The charts on both sides, the lesser number first.
    pub(super) charts: [u32; 2],
}

/// All arcs, in the order of their first edges.
pub(super) fn arcs(layout: &Layout<'_>) -> Vec<Arc> {
    let mesh = layout.mesh();
    let is_node = |v: VertexId| layout.degrees[v] != 2 || mesh.is_boundary_vertex(v);
    let mut seen = vec![false; mesh.edges()];
    let mut arcs = Vec::new();
    for first in mesh.edge_ids() {
        if !layout.seams[first] || mesh.is_boundary_edge(first) || seen[first.index()] {
            continue;
        }
        seen[first.index()] = true;
        let [tail, head] = mesh.ends(first);
        let mut walk = |from: VertexId| {
            let (mut at, mut edges) = (from, Vec::new());
            while !is_node(at) {
                let around = mesh.outgoing(at).map(|h| mesh.edge(h));
                let next = around.into_iter().find(|&edge| layout.seams[edge] && !seen[edge.index()]);
                let Some(edge) = next else { break };
                seen[edge.index()] = true;
                edges.push(edge);
                let [a, b] = mesh.ends(edge);
                at = if a == at { b } else { a };
            }
            (edges, at)
        };
        let (mut back, start) = walk(tail);
        let (forth, end) = walk(head);
        back.reverse();
        let edges: Vec<EdgeId> = back.into_iter().chain([first]).chain(forth).collect();
        let h = mesh.edge_halfedge(first);
        let mut charts = [h, mesh.twin(h).unwrap_or(h)].map(|h| layout.chart_of[h.face().index()]);
        charts.sort_unstable();
        arcs.push(Arc { edges, ends: [start, end], charts });
    }
    arcs
}

impl Arc {
    /// The sets of edges that may be closed so that disks remain: the whole arc between two charts, or some of one from its free end.
    pub(super) fn closings(&self, layout: &Layout<'_>) -> Vec<Vec<EdgeId>> {
        let is_free = |v: VertexId| layout.degrees[v] == 1 && !layout.mesh().is_boundary_vertex(v);
        let [start, end] = self.ends.map(is_free);
        let count = |share: f64| (share * self.edges.len() as f64).ceil() as usize;
        match (start, end) {
            (true, _) => SHARES.iter().map(|&share| self.edges[..count(share)].to_vec()).collect(),
            (_, true) => {
                SHARES.iter().map(|&share| self.edges[self.edges.len() - count(share)..].to_vec()).collect()
            }
            _ if self.charts[0] != self.charts[1] => vec![self.edges.clone()],
            _ => Vec::new(),
        }
    }
}
