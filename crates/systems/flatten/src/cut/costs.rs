//! What it costs to cut along each edge.

use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::{EdgeData, EdgeId, Surface};

/// The cost of each edge: its length; infinite where no cut may go.
#[derive(Clone, Debug)]
pub(crate) struct Costs {
    of_edge: EdgeData<f64>,
    is_forbidden: VertexData<bool>,
}

impl Costs {
    /// The lengths, infinite where an end is forbidden.
    pub(crate) fn new(surface: &Surface, forbidden: &[VertexId]) -> Self {
        let mesh = surface.mesh();
        let mut is_forbidden = VertexData::filled(mesh.vertices(), false);
        for &v in forbidden {
            is_forbidden[v] = true;
        }
        let cost = |edge| {
            let is_closed = mesh.ends(edge).into_iter().any(|v| is_forbidden[v]);
            if is_closed { f64::INFINITY } else { surface.edge_length(edge) }
        };
        Self { of_edge: EdgeData::from_fn(mesh.edges(), cost), is_forbidden }
    }

    pub(crate) fn of(&self, edge: EdgeId) -> f64 {
        self.of_edge[edge]
    }

    /// Whether no cut may touch a vertex.
    pub(crate) fn forbid(&self, vertex: VertexId) -> bool {
        self.is_forbidden[vertex]
    }

    /// The cost of a set of edges.
    pub(crate) fn total(&self, cut: &EdgeData<bool>) -> f64 {
        cut.entries().filter(|(_, is_cut)| **is_cut).map(|(edge, _)| self.of_edge[edge]).sum()
    }
}
