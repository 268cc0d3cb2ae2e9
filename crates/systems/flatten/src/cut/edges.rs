//! Edges by their ends, and edges added to a cut.

use pompeiu_core::VertexId;
use pompeiu_core::mesh::UnionFind;
use pompeiu_surface::{EdgeData, EdgeId, SurfaceMesh};

/// The edge between two vertices.
pub(crate) fn edge_between(mesh: &SurfaceMesh, [a, b]: [VertexId; 2]) -> Option<EdgeId> {
    let around = mesh.outgoing(a).flat_map(|h| [h, h.previous()]);
    around.into_iter().find(|&h| a != b && [mesh.tail(h), mesh.head(h)].contains(&b)).map(|h| mesh.edge(h))
}

/// Adds edges to a cut in order, omitting those that would close a new loop.
pub(super) fn joined_edges(mesh: &SurfaceMesh, cut: &EdgeData<bool>, edges: &[EdgeId]) -> EdgeData<bool> {
    let mut joined = UnionFind::new(mesh.vertices());
    let of_cut = mesh.edge_ids().filter(|&edge| cut[edge] || mesh.is_boundary_edge(edge));
    for edge in of_cut {
        let [a, b] = mesh.ends(edge);
        joined.union(a.index(), b.index());
    }
    let mut cut = cut.clone();
    for &edge in edges {
        let [a, b] = mesh.ends(edge);
        if joined.union(a.index(), b.index()) {
            cut[edge] = true;
        }
    }
    cut
}
