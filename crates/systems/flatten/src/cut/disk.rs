//! Cutting a connected surface of any genus and any number of boundary loops into a disk.

use super::costs::Costs;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::UnionFind;
use pompeiu_surface::{EdgeData, EdgeDistances, EdgeId, HalfedgeId, Surface};

/// Largest number of roots tried on closed surfaces, and the number of vertices above which fewer are tried.
const MOST_ROOTS: usize = 24;
const VERTICES_FOR_ALL_ROOTS: usize = 200_000;

/// A set of edges that cuts a connected surface into a disk; empty for a disk and for a sphere.
///
/// # Definition
/// Faces are joined across edges into a spanning tree. Edges are taken in decreasing order of the sum of both ends' distances and
/// their own length, and the edges of shortest paths last. The distances are those from the boundary or, without one, from a root.
/// The edges not crossed are pruned until every branch ends at the boundary or in a loop. Closed surfaces are cut from several
/// roots, far from each other, and the shortest cut is taken.
///
/// # Source
/// `erickson_optimally_2004` for the tree–cotree decomposition; `erickson_greedy_2005` for the order.
pub(crate) fn disk_cut(surface: &Surface, costs: &Costs) -> EdgeData<bool> {
    let mesh = surface.mesh();
    let boundary: Vec<VertexId> = mesh.vertex_ids().filter(|&v| mesh.is_boundary_vertex(v)).collect();
    if mesh.genus() == 0 && mesh.boundary_loops().len() < 2 {
        return EdgeData::filled(mesh.edges(), false);
    }
    if !boundary.is_empty() {
        return cut_from(surface, costs, &boundary);
    }
    let lengths = surface.edge_lengths();
    let roots = (VERTICES_FOR_ALL_ROOTS / mesh.vertices()).clamp(1, MOST_ROOTS);
    let mut nearest = vec![f64::INFINITY; mesh.vertices()];
    let mut root = VertexId(0);
    let mut best: Option<(f64, EdgeData<bool>)> = None;
    for _ in 0..roots {
        let cut = cut_from(surface, costs, &[root]);
        let length = costs.total(&cut);
        if best.as_ref().is_none_or(|(least, _)| length < *least) {
            best = Some((length, cut));
        }
        let from = EdgeDistances::along(surface, &[root], |edge| lengths[edge]);
        for (near, distance) in nearest.iter_mut().zip(&from.distances) {
            *near = near.min(*distance);
        }
        root = VertexId(super::largest(&nearest) as u32);
    }
    best.map_or_else(|| EdgeData::filled(mesh.edges(), false), |(_, cut)| cut)
}

fn cut_from(surface: &Surface, costs: &Costs, sources: &[VertexId]) -> EdgeData<bool> {
    let mesh = surface.mesh();
    let from = EdgeDistances::along(surface, sources, |edge| costs.of(edge));
    let mut in_tree = EdgeData::filled(mesh.edges(), false);
    for v in mesh.vertex_ids() {
        if let Some(h) = from.last_step(v) {
            in_tree[mesh.edge(h)] = true;
        }
    }
    // Forbidden edges have infinite weight, and are crossed first.
    let weight = |edge: EdgeId| {
        let [u, v] = mesh.ends(edge);
        from.distances[u] + from.distances[v] + costs.of(edge)
    };
    let mut order: Vec<(bool, f64, EdgeId)> = mesh
        .edge_ids()
        .filter(|&edge| !mesh.is_boundary_edge(edge))
        .map(|edge| (in_tree[edge], weight(edge), edge))
        .collect();
    order.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(a.2.cmp(&b.2)));
    let mut faces = UnionFind::new(mesh.faces());
    let mut cut = EdgeData::filled(mesh.edges(), false);
    for (.., edge) in order {
        let h = mesh.edge_halfedge(edge);
        let across = mesh.twin(h).map_or(h.face(), HalfedgeId::face);
        cut[edge] = !faces.union(h.face().index(), across.index());
    }
    prune(surface, &mut cut, |_| false);
    cut
}

/// Repeatedly removes dangling edges from a cut; edges at vertices that are kept do not dangle.
pub(super) fn prune(surface: &Surface, cut: &mut EdgeData<bool>, is_kept: impl Fn(VertexId) -> bool) {
    let mesh = surface.mesh();
    let mut degrees = vec![0_u32; mesh.vertices()];
    for edge in mesh.edge_ids().filter(|&edge| cut[edge]) {
        for v in mesh.ends(edge) {
            degrees[v.index()] += 1;
        }
    }
    let is_leaf =
        |degrees: &[u32], v: VertexId| degrees[v.index()] == 1 && !mesh.is_boundary_vertex(v) && !is_kept(v);
    let mut leaves: Vec<VertexId> = mesh.vertex_ids().filter(|&v| is_leaf(&degrees, v)).collect();
    while let Some(v) = leaves.pop() {
        if degrees[v.index()] != 1 {
            continue;
        }
        let last = mesh.outgoing(v).find(|&h| cut[mesh.edge(h)]);
        let Some(h) = last else { continue };
        cut[mesh.edge(h)] = false;
        for w in [v, mesh.head(h)] {
            degrees[w.index()] -= 1;
        }
        if is_leaf(&degrees, mesh.head(h)) {
            leaves.push(mesh.head(h));
        }
    }
}
