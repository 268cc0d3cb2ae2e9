//! Costs of cutting along edges.

use super::CutOptions;
use super::edge_between;
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceMesh};

/// Vertices and edges where no cut may go.
#[derive(Clone, Debug)]
pub(super) struct Closed {
    vertices: VertexData<bool>,
    edges: EdgeData<bool>,
}

impl Closed {
    /// The forbidden places of the options; all of them must exist.
    pub(super) fn new(mesh: &SurfaceMesh, options: &CutOptions) -> Self {
        let mut vertices = VertexData::filled(mesh.vertices(), false);
        for &v in &options.forbidden {
            vertices[v] = true;
        }
        let mut edges = EdgeData::filled(mesh.edges(), false);
        for edge in options.forbidden_edges.iter().filter_map(|&ends| edge_between(mesh, ends)) {
            edges[edge] = true;
        }
        if !options.forbidden_faces.is_empty() {
            let mut faces = FaceData::filled(mesh.faces(), false);
            for &face in &options.forbidden_faces {
                faces[face] = true;
            }
            for edge in mesh.edge_ids() {
                let h = mesh.edge_halfedge(edge);
                edges[edge] |= faces[h.face()] && mesh.twin(h).is_none_or(|twin| faces[twin.face()]);
            }
            for v in mesh.vertex_ids() {
                vertices[v] |= mesh.outgoing(v).all(|h| faces[h.face()]);
            }
        }
        for edge in mesh.edge_ids() {
            edges[edge] |= mesh.ends(edge).into_iter().any(|v| vertices[v]);
        }
        Self { vertices, edges }
    }

    pub(super) fn forbid_edge(&self, edge: EdgeId) -> bool {
        self.edges[edge]
    }
}

/// The cost of each edge: its length, increased by curvature on request; infinite where no cut may go.
#[derive(Clone, Debug)]
pub(crate) struct Costs {
    of_edge: EdgeData<f64>,
    is_forbidden: VertexData<bool>,
}

impl Costs {
    pub(crate) fn new(surface: &EmbeddedSurface, options: &CutOptions) -> Self {
        let mesh = surface.mesh();
        let closed = Closed::new(mesh, options);
        let lengths = surface.surface().edge_lengths();
        let curved = (options.curvature > 0.0).then(|| mean_curvatures(surface));
        let unit = options.curvature * surface.surface().area().sqrt();
        let cost = |edge: EdgeId| {
            if closed.edges[edge] {
                return f64::INFINITY;
            }
            let factor = curved.as_ref().map_or(1.0, |curved| {
                let [a, b] = mesh.ends(edge);
                1.0 + unit * 0.5 * (curved[a] + curved[b])
            });
            factor * lengths[edge]
        };
        Self { of_edge: EdgeData::from_fn(mesh.edges(), cost), is_forbidden: closed.vertices }
    }

    /// Modified costs of the same edges.
    pub(super) fn changed(&self, cost: impl Fn(EdgeId, f64) -> f64) -> Self {
        let of_edge = EdgeData::from_fn(self.of_edge.len(), |edge| cost(edge, self.of_edge[edge]));
        Self { of_edge, is_forbidden: self.is_forbidden.clone() }
    }

    /// The costs for the edges of another mesh, whose vertices are a subset of these.
    pub(crate) fn elsewhere(
        &self,
        mesh: &SurfaceMesh,
        cost: impl Fn(EdgeId) -> f64,
        vertex: impl Fn(VertexId) -> VertexId,
    ) -> Self {
        let of_edge = EdgeData::from_fn(mesh.edges(), cost);
        let is_forbidden = VertexData::from_fn(mesh.vertices(), |v| self.is_forbidden[vertex(v)]);
        Self { of_edge, is_forbidden }
    }

    pub(crate) fn of(&self, edge: EdgeId) -> f64 {
        self.of_edge[edge]
    }

    /// Whether cuts may not touch a vertex.
    pub(crate) fn forbid(&self, vertex: VertexId) -> bool {
        self.is_forbidden[vertex]
    }

    /// The cost of a set of edges.
    pub(crate) fn total(&self, cut: &EdgeData<bool>) -> f64 {
        cut.entries().filter(|(_, is_cut)| **is_cut).map(|(edge, _)| self.of_edge[edge]).sum()
    }
}

/// The absolute mean curvature around each vertex: a quarter of the sum, over its edges, of length times dihedral angle, divided by
/// its area.
fn mean_curvatures(surface: &EmbeddedSurface) -> VertexData<f64> {
    let mesh = surface.mesh();
    let areas = surface.surface().vertex_areas();
    let mut sums = VertexData::filled(mesh.vertices(), 0.0);
    for edge in mesh.edge_ids() {
        let h = mesh.edge_halfedge(edge);
        let Some(twin) = mesh.twin(h) else { continue };
        let [m, n] = [h, twin].map(|h| DVec3::from_array(surface.frame(h.face())[2]));
        let angle = libm::atan2(m.cross(n).length(), m.dot(n));
        for v in mesh.ends(edge) {
            sums[v] += 0.25 * surface.surface().edge_length(edge) * angle;
        }
    }
    VertexData::from_fn(mesh.vertices(), |v: VertexId| sums[v] / areas[v])
}
