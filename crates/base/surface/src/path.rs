//! Shortest paths along edges.

use crate::{EdgeId, HalfedgeId, Surface};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Distances along edges from some vertices to all others, and the shortest paths.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeDistances {
    /// For each vertex, the length of the shortest path of edges from the nearest source; infinite if there is none.
    pub distances: VertexData<f64>,
    /// For each vertex, the last half-edge of its path, in either direction; `None` at sources.
    last: VertexData<Option<HalfedgeId>>,
}

impl EdgeDistances {
    /// The distances from a set of vertices.
    ///
    /// # Accuracy
    /// An upper bound of the geodesic distance, up to about twice as long; it does not converge under refinement.
    /// # Panics
    /// If a vertex does not exist.
    /// # Cost
    /// O(E log E).
    pub fn from(surface: &Surface, sources: &[VertexId]) -> Self {
        Self::along(surface, sources, |edge| surface.edge_length(edge))
    }

    /// The least costs of paths from a set of vertices. Edges have nonnegative costs; an infinite cost excludes an edge.
    ///
    /// # Panics
    /// If a vertex does not exist.
    /// # Cost
    /// O(E log E).
    pub fn along(surface: &Surface, sources: &[VertexId], cost: impl Fn(EdgeId) -> f64) -> Self {
        Self::through(surface, sources, cost, |_| true)
    }

    /// As [`EdgeDistances::along`], of paths that lead only through some vertices; they may start and end at all.
    ///
    /// # Panics
    /// If a vertex does not exist.
    /// # Cost
    /// O(E log E).
    pub fn through(
        surface: &Surface,
        sources: &[VertexId],
        cost: impl Fn(EdgeId) -> f64,
        leads: impl Fn(VertexId) -> bool,
    ) -> Self {
        let mesh = surface.mesh();
        let mut distances = VertexData::filled(mesh.vertices(), f64::INFINITY);
        let mut last = VertexData::filled(mesh.vertices(), None);
        // The bits of nonnegative doubles are ordered like the numbers, so integers serve as heap keys.
        let mut open = BinaryHeap::new();
        for &source in sources {
            distances[source] = 0.0;
            open.push(Reverse((0_u64, source.0)));
        }
        while let Some(Reverse((bits, v))) = open.pop() {
            let v = VertexId(v);
            let distance = f64::from_bits(bits);
            if distance > distances[v] || (last[v].is_some() && !leads(v)) {
                continue;
            }
            for out in mesh.outgoing(v) {
                for (h, w) in [(out, mesh.head(out)), (out.previous(), mesh.tail(out.previous()))] {
                    let through = distance + cost(mesh.edge(h));
                    if through < distances[w] {
                        distances[w] = through;
                        last[w] = Some(h);
                        open.push(Reverse((through.to_bits(), w.0)));
                    }
                }
            }
        }
        Self { distances, last }
    }

    /// The last half-edge, in either direction, of the shortest path to a vertex; `None` if it is a source or unreachable.
    ///
    /// # Panics
    /// If the vertex does not exist.
    pub fn last_step(&self, vertex: VertexId) -> Option<HalfedgeId> {
        self.last[vertex]
    }

    /// The edges of the shortest path from a source to a vertex, in order; none if the vertex is a source or unreachable.
    ///
    /// # Panics
    /// If the vertex does not exist.
    pub fn path_to(&self, surface: &Surface, vertex: VertexId) -> Vec<EdgeId> {
        let mesh = surface.mesh();
        let mut path = Vec::new();
        let mut at = vertex;
        while let Some(h) = self.last[at] {
            path.push(mesh.edge(h));
            at = if mesh.head(h) == at { mesh.tail(h) } else { mesh.head(h) };
        }
        path.reverse();
        path
    }
}
