//! Connectivity: half-edges and their twins.

use crate::build::{NONE, Pairs, sides, turns};
use crate::{EdgeId, HalfedgeId, SurfaceError};
use pompeiu_core::{FaceId, TriMesh, VertexId};

/// The connectivity of an oriented manifold triangle surface, with or without boundary, of any number of components.
///
/// Index arrays only: half-edge `3 f + i` belongs to face `f` and starts at its corner `i`, so faces and next and previous
/// half-edges need no memory. The twin of a half-edge runs along the same edge in the opposite direction; a half-edge without a
/// twin is at the boundary. Edges are numbered in the order of their first half-edge and directed along it.
///
/// Every vertex has faces, and they form one fan, closed or open.
///
/// # Shapes and units
/// 36 bytes per face, 4 per edge, 8 per vertex.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SurfaceMesh {
    /// Start of each half-edge.
    tails: Vec<u32>,
    twins: Vec<u32>,
    edges: Vec<u32>,
    /// First half-edge of each edge.
    edge_halfedges: Vec<u32>,
    /// For each vertex an outgoing half-edge: at the boundary the clockwise-most one, so that all others follow counter-clockwise.
    vertex_halfedges: Vec<u32>,
    /// Component of each vertex.
    components: Vec<u32>,
    component_count: usize,
    /// One half-edge of each boundary loop.
    boundary_loops: Vec<HalfedgeId>,
}

impl SurfaceMesh {
    /// The connectivity of a mesh.
    ///
    /// # Errors
    /// [`SurfaceError`] names the first offending element.
    ///
    /// # Cost
    /// O(F log F) at worst, O(F) at bounded valence.
    pub fn new(mesh: &TriMesh) -> Result<Self, SurfaceError> {
        Self::from_faces(mesh.positions().len(), mesh.faces())
    }

    /// The connectivity of faces with vertex indices below `vertices`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_faces(vertices: usize, faces: &[[u32; 3]]) -> Result<Self, SurfaceError> {
        let pairs = Pairs::new(vertices, faces)?;
        pairs.check_two_faces()?;
        let mut twins = vec![NONE; 3 * faces.len()];
        let direction = |h: u32| sides(faces[h as usize / 3])[h as usize % 3];
        for edge in pairs.iter() {
            if let [(_, g), (_, h)] = *edge {
                if direction(g) == direction(h) {
                    // Only a traversal of all faces tells inconsistent orientation from a non-orientable surface.
                    turns(vertices, faces)?;
                    let faces = [g, h].map(|h| FaceId(h / 3));
                    return Err(SurfaceError::Misoriented { faces, ends: direction(g).map(VertexId) });
                }
                twins[g as usize] = h;
                twins[h as usize] = g;
            }
        }
        drop(pairs);
        Self::from_twins(vertices, faces.as_flattened().to_vec(), twins)
    }

    /// The connectivity of half-edges that are glued in pairs. Edges may join a vertex to itself, and several edges may join the
    /// same two vertices.
    pub(crate) fn from_twins(
        vertices: usize,
        tails: Vec<u32>,
        twins: Vec<u32>,
    ) -> Result<Self, SurfaceError> {
        let mut edges = vec![NONE; tails.len()];
        let mut edge_halfedges = Vec::with_capacity(tails.len() / 2);
        for h in 0..tails.len() {
            if edges[h] == NONE {
                edges[h] = edge_halfedges.len() as u32;
                if twins[h] != NONE {
                    edges[twins[h] as usize] = edges[h];
                }
                edge_halfedges.push(h as u32);
            }
        }
        let mut vertex_halfedges = vec![NONE; vertices];
        let mut face_counts = vec![0_usize; vertices];
        for (h, &tail) in tails.iter().enumerate() {
            face_counts[tail as usize] += 1;
            let first = &mut vertex_halfedges[tail as usize];
            if *first == NONE || twins[h] == NONE {
                *first = h as u32;
            }
        }
        if let Some(v) = vertex_halfedges.iter().position(|&h| h == NONE) {
            return Err(SurfaceError::UnreferencedVertex { vertex: VertexId(v as u32) });
        }
        let mut mesh = Self {
            tails,
            twins,
            edges,
            edge_halfedges,
            vertex_halfedges,
            components: Vec::new(),
            component_count: 0,
            boundary_loops: Vec::new(),
        };
        for (v, &faces) in face_counts.iter().enumerate() {
            let vertex = VertexId(v as u32);
            if mesh.outgoing(vertex).count() != faces {
                return Err(SurfaceError::NonManifoldVertex { vertex, faces });
            }
        }
        mesh.find_components();
        mesh.find_boundary_loops();
        Ok(mesh)
    }

    fn find_components(&mut self) {
        let mut components = vec![NONE; self.vertices()];
        let mut open = Vec::new();
        for seed in 0..self.vertices() as u32 {
            if components[seed as usize] != NONE {
                continue;
            }
            components[seed as usize] = self.component_count as u32;
            open.push(VertexId(seed));
            while let Some(v) = open.pop() {
                // The heads of the outgoing half-edges, and at a boundary also the tail of the incoming boundary half-edge.
                for h in self.outgoing(v) {
                    for w in [self.tail(h.next()), self.tail(h.previous())] {
                        if components[w.index()] == NONE {
                            components[w.index()] = self.component_count as u32;
                            open.push(w);
                        }
                    }
                }
            }
            self.component_count += 1;
        }
        self.components = components;
    }

    fn find_boundary_loops(&mut self) {
        let mut seen = vec![false; self.tails.len()];
        for h in 0..self.tails.len() as u32 {
            if self.twins[h as usize] == NONE && !seen[h as usize] {
                self.boundary_loops.push(HalfedgeId(h));
                for along in self.boundary_loop(HalfedgeId(h)) {
                    seen[along.index()] = true;
                }
            }
        }
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.vertex_halfedges.len()
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        self.edge_halfedges.len()
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.tails.len() / 3
    }

    /// Number of half-edges, three per face.
    pub fn halfedges(&self) -> usize {
        self.tails.len()
    }

    /// All faces, in order.
    pub fn face_ids(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.faces() as u32).map(FaceId)
    }

    /// All edges, in order.
    pub fn edge_ids(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        (0..self.edges() as u32).map(EdgeId)
    }

    /// All vertices, in order.
    pub fn vertex_ids(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertices() as u32).map(VertexId)
    }

    /// The vertices of a face.
    pub fn face(&self, face: FaceId) -> [VertexId; 3] {
        let first = 3 * face.index();
        [0, 1, 2].map(|i| VertexId(self.tails[first + i]))
    }

    /// The three half-edges of a face.
    pub fn face_halfedges(face: FaceId) -> [HalfedgeId; 3] {
        [0, 1, 2].map(|corner| HalfedgeId::of(face, corner))
    }

    /// The vertex where a half-edge starts.
    #[inline]
    pub fn tail(&self, halfedge: HalfedgeId) -> VertexId {
        VertexId(self.tails[halfedge.index()])
    }

    /// The vertex where a half-edge ends.
    #[inline]
    pub fn head(&self, halfedge: HalfedgeId) -> VertexId {
        self.tail(halfedge.next())
    }

    /// The half-edge along the same edge in the neighbouring face, `None` at the boundary.
    #[inline]
    pub fn twin(&self, halfedge: HalfedgeId) -> Option<HalfedgeId> {
        let twin = self.twins[halfedge.index()];
        (twin != NONE).then_some(HalfedgeId(twin))
    }

    /// The edge along which a half-edge runs.
    #[inline]
    pub fn edge(&self, halfedge: HalfedgeId) -> EdgeId {
        EdgeId(self.edges[halfedge.index()])
    }

    /// The half-edge that gives an edge its direction.
    #[inline]
    pub fn edge_halfedge(&self, edge: EdgeId) -> HalfedgeId {
        HalfedgeId(self.edge_halfedges[edge.index()])
    }

    /// The ends of an edge, in its direction.
    pub fn ends(&self, edge: EdgeId) -> [VertexId; 2] {
        let h = self.edge_halfedge(edge);
        [self.tail(h), self.head(h)]
    }

    /// Whether a half-edge runs in the direction of its edge.
    #[inline]
    pub fn is_along(&self, halfedge: HalfedgeId) -> bool {
        self.edge_halfedges[self.edges[halfedge.index()] as usize] == halfedge.0
    }

    /// Whether an edge has one face only.
    #[inline]
    pub fn is_boundary_edge(&self, edge: EdgeId) -> bool {
        self.twins[self.edge_halfedge(edge).index()] == NONE
    }

    /// Whether a vertex lies on the boundary.
    #[inline]
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        self.twins[self.vertex_halfedges[vertex.index()] as usize] == NONE
    }

    /// The half-edges out of a vertex, one per face around it, counter-clockwise; at the boundary from one end of the fan to the
    /// other.
    pub fn outgoing(&self, vertex: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let first = HalfedgeId(self.vertex_halfedges[vertex.index()]);
        std::iter::successors(Some(first), move |h| self.twin(h.previous()).filter(|&next| next != first))
    }

    /// The half-edges of the boundary loop that a boundary half-edge is part of, in order, starting with it.
    pub fn boundary_loop(&self, halfedge: HalfedgeId) -> impl Iterator<Item = HalfedgeId> + '_ {
        std::iter::successors(Some(halfedge), move |&h| {
            let next = HalfedgeId(self.vertex_halfedges[self.head(h).index()]);
            (next != halfedge && self.twin(next).is_none()).then_some(next)
        })
    }

    /// One half-edge of each boundary loop.
    pub fn boundary_loops(&self) -> &[HalfedgeId] {
        &self.boundary_loops
    }

    /// Number of connected components.
    pub fn components(&self) -> usize {
        self.component_count
    }

    /// The component of a vertex, from 0.
    pub fn component(&self, vertex: VertexId) -> usize {
        self.components[vertex.index()] as usize
    }

    /// Number of boundary loops of each component.
    pub fn boundary_loops_of_components(&self) -> Vec<usize> {
        let mut counts = vec![0; self.component_count];
        for &h in &self.boundary_loops {
            counts[self.component(self.tail(h))] += 1;
        }
        counts
    }

    /// Vertices minus edges plus faces.
    pub fn euler_characteristic(&self) -> isize {
        self.vertices().cast_signed() - self.edges().cast_signed() + self.faces().cast_signed()
    }

    /// Number of handles, all components together.
    pub fn genus(&self) -> usize {
        let caps = self.euler_characteristic() + self.boundary_loops.len().cast_signed();
        ((2 * self.component_count.cast_signed() - caps) / 2).unsigned_abs()
    }
}
