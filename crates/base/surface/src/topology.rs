//! Generators of the first homology, and dual closed forms.

use crate::build::NONE;
use crate::{EdgeId, HalfedgeId, SurfaceMesh};
use pompeiu_core::{FaceId, VertexId};
use std::collections::VecDeque;

/// Absolute or relative homology of a surface with boundary. On a closed surface the two are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relative {
    /// Absolute homology: closed loops; forms are arbitrary on the boundary.
    ToNothing,
    /// Homology relative to the boundary: closed loops and paths from boundary to boundary; forms vanish on the boundary.
    ToBoundary,
}

/// A sum of edges, each with the sign of its direction.
pub type Chain = Vec<(EdgeId, i8)>;

/// Generators of the first homology of a surface, and the dual generators of its first cohomology.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generators {
    /// Loops of edges (or paths from boundary to boundary) that generate all others, each in order.
    pub loops: Vec<Chain>,
    /// Closed forms: around each face their values add up to zero, in integers. The form with index i is 1 on the loop
    /// with index i and 0 on all others.
    pub forms: Vec<Chain>,
}

/// Generators of loops and closed forms, by tree–cotree decomposition.
///
/// # Definition
/// A spanning tree T of the vertices, and a spanning tree C of the faces, joined across edges outside T. Each edge in neither is a
/// generator: with its path in T it makes a loop, with its path in C the dual of a closed form. There are 2g per closed component
/// of genus g, and 2g + b − 1 with b boundary loops. In absolute homology the outside of each component counts as one more face;
/// relative to the boundary, the boundary counts as one vertex.
///
/// # Cost
/// O(F), and O(length) for each generator; trees are breadth-first, so loops are short but not the shortest.
///
/// # Source
/// `eppstein_dynamic_2003`; `erickson_greedy_2005` for loops from the two trees. Surfaces with boundary as said above.
pub fn tree_cotree(mesh: &SurfaceMesh, relative: Relative) -> Generators {
    let tree = VertexTree::new(mesh, relative);
    let cotree = FaceTree::new(mesh, relative, &tree);
    let is_open = |&edge: &EdgeId| {
        let outside = relative == Relative::ToBoundary && mesh.is_boundary_edge(edge);
        !outside && !tree.used[edge.index()] && !cotree.used[edge.index()]
    };
    let edges: Vec<EdgeId> = mesh.edge_ids().filter(is_open).collect();
    Generators {
        loops: edges.iter().map(|&edge| tree.cycle(mesh, edge)).collect(),
        forms: edges.iter().map(|&edge| cotree.form(mesh, edge)).collect(),
    }
}

/// A spanning forest of the vertices: one tree per closed component, and one per boundary vertex of the others.
struct VertexTree {
    /// Whether an edge is in the forest.
    used: Vec<bool>,
    /// The half-edge, of either direction, to the parent of each vertex.
    parents: Vec<u32>,
    depths: Vec<u32>,
}

impl VertexTree {
    fn new(mesh: &SurfaceMesh, relative: Relative) -> Self {
        let mut tree = Self {
            used: vec![false; mesh.edges()],
            parents: vec![NONE; mesh.vertices()],
            depths: vec![NONE; mesh.vertices()],
        };
        let mut rooted = vec![false; mesh.components()];
        let mut open = VecDeque::new();
        if relative == Relative::ToBoundary {
            for v in mesh.vertex_ids().filter(|&v| mesh.is_boundary_vertex(v)) {
                rooted[mesh.component(v)] = true;
                tree.depths[v.index()] = 0;
                open.push_back(v);
            }
        }
        for v in mesh.vertex_ids() {
            if !rooted[mesh.component(v)] {
                rooted[mesh.component(v)] = true;
                tree.depths[v.index()] = 0;
                open.push_back(v);
            }
        }
        while let Some(v) = open.pop_front() {
            for out in mesh.outgoing(v) {
                for (h, w) in [(out, mesh.head(out)), (out.previous(), mesh.tail(out.previous()))] {
                    if tree.depths[w.index()] == NONE {
                        tree.depths[w.index()] = tree.depths[v.index()] + 1;
                        tree.parents[w.index()] = h.0;
                        tree.used[mesh.edge(h).index()] = true;
                        open.push_back(w);
                    }
                }
            }
        }
        tree
    }

    /// The parent of a vertex, and the edge to it with its sign.
    fn step(&self, mesh: &SurfaceMesh, v: VertexId) -> (VertexId, (EdgeId, i8)) {
        let h = HalfedgeId(self.parents[v.index()]);
        let leads_up = mesh.tail(h) == v;
        let parent = if leads_up { mesh.head(h) } else { mesh.tail(h) };
        let sign = if mesh.is_along(h) == leads_up { 1 } else { -1 };
        (parent, (mesh.edge(h), sign))
    }

    /// The loop along the edge and back through the tree.
    fn cycle(&self, mesh: &SurfaceMesh, edge: EdgeId) -> Chain {
        let [mut start, mut end] = mesh.ends(edge);
        let mut up = vec![(edge, 1)];
        let mut down = Vec::new();
        let is_root = |v: VertexId| self.parents[v.index()] == NONE;
        while start != end && !(is_root(start) && is_root(end)) {
            if self.depths[end.index()] >= self.depths[start.index()] {
                let (parent, step) = self.step(mesh, end);
                up.push(step);
                end = parent;
            } else {
                let (parent, (edge, sign)) = self.step(mesh, start);
                down.push((edge, -sign));
                start = parent;
            }
        }
        up.extend(down.into_iter().rev());
        up
    }
}

/// A spanning forest of the faces, joined across edges that are not in the tree of vertices.
struct FaceTree {
    used: Vec<bool>,
    /// The half-edge of each face across which its parent lies.
    parents: Vec<u32>,
    depths: Vec<u32>,
}

impl FaceTree {
    fn new(mesh: &SurfaceMesh, relative: Relative, tree: &VertexTree) -> Self {
        let mut cotree = Self {
            used: vec![false; mesh.edges()],
            parents: vec![NONE; mesh.faces()],
            depths: vec![NONE; mesh.faces()],
        };
        let mut rooted = vec![false; mesh.components()];
        let mut open = VecDeque::new();
        if relative == Relative::ToNothing {
            // The root is the outside.
            for h in mesh.edge_ids().map(|edge| mesh.edge_halfedge(edge)) {
                let (f, edge) = (h.face(), mesh.edge(h));
                if mesh.twin(h).is_none() && !tree.used[edge.index()] {
                    rooted[mesh.component(mesh.tail(h))] = true;
                    if cotree.depths[f.index()] == NONE {
                        cotree.depths[f.index()] = 1;
                        cotree.parents[f.index()] = h.0;
                        cotree.used[edge.index()] = true;
                        open.push_back(f);
                    }
                }
            }
        }
        for f in mesh.face_ids() {
            let component = mesh.component(mesh.face(f)[0]);
            if !rooted[component] {
                rooted[component] = true;
                cotree.depths[f.index()] = 0;
                open.push_back(f);
            }
        }
        while let Some(f) = open.pop_front() {
            for h in SurfaceMesh::face_halfedges(f) {
                let Some(twin) = mesh.twin(h) else { continue };
                let (g, edge) = (twin.face(), mesh.edge(h));
                if !tree.used[edge.index()] && cotree.depths[g.index()] == NONE {
                    cotree.depths[g.index()] = cotree.depths[f.index()] + 1;
                    cotree.parents[g.index()] = twin.0;
                    cotree.used[edge.index()] = true;
                    open.push_back(g);
                }
            }
        }
        cotree
    }

    /// The form that counts how often a path crosses the cycle of faces through an edge.
    ///
    /// A cycle that enters a face across one half-edge and leaves it across another counts 1 along the first and −1 along
    /// the second, so that every face sums to zero.
    fn form(&self, mesh: &SurfaceMesh, edge: EdgeId) -> Chain {
        let h = mesh.edge_halfedge(edge);
        let mut form = vec![(edge, 1)];
        // The cycle enters through `h` and goes up from there; on the other side it comes down to the twin.
        let mut up = Some(h.face());
        let mut down = mesh.twin(h).map(HalfedgeId::face);
        let depth = |face: Option<FaceId>| face.map_or(0, |f| self.depths[f.index()]);
        while up != down {
            let (face, sign) = if depth(up) >= depth(down) { (&mut up, -1) } else { (&mut down, 1) };
            let Some(f) = *face else { break };
            let parent = self.parents[f.index()];
            if parent == NONE {
                break;
            }
            let crossed = HalfedgeId(parent);
            form.push((mesh.edge(crossed), if mesh.is_along(crossed) { sign } else { -sign }));
            *face = mesh.twin(crossed).map(HalfedgeId::face);
        }
        form
    }
}
