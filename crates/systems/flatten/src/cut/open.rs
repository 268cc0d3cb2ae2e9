//! Opening a surface along edges.

use super::CutError;
use pompeiu_core::mesh::VertexData;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::{EdgeData, HalfedgeId, SurfaceMesh};

/// A surface opened along edges: the same faces with the same corners, and a copy of each vertex for every fan into which the cut
/// divides its faces.
///
/// The first copy keeps the index of the vertex, so the input's vertices come first; further copies follow in the order of their
/// vertices, counter-clockwise around each.
#[derive(Clone, Debug, PartialEq)]
pub struct Opened {
    mesh: SurfaceMesh,
    faces: Vec<[u32; 3]>,
    vertex_map: VertexData<VertexId>,
}

impl Opened {
    /// The connectivity after the cut.
    pub fn mesh(&self) -> &SurfaceMesh {
        &self.mesh
    }

    /// The faces after the cut: those of the input with new vertex indices.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// For each vertex after the cut, the vertex of the input that it is a copy of.
    pub fn vertex_map(&self) -> &VertexData<VertexId> {
        &self.vertex_map
    }

    /// The faces with all copies identified: those of the input.
    pub fn glued_faces(&self) -> Vec<[u32; 3]> {
        self.faces.iter().map(|face| face.map(|v| self.vertex_map[VertexId(v)].0)).collect()
    }

    /// The value of each copy, from the values of the vertices of the input.
    pub fn spread<T: Clone>(&self, values: &[T]) -> Vec<T> {
        self.vertex_map.iter().map(|v| values[v.index()].clone()).collect()
    }

    /// Checks that every component is a disk: one boundary loop and Euler characteristic 1.
    ///
    /// # Errors
    /// [`CutError::NoDisk`] names the first component that is no disk.
    pub fn check_disks(&self) -> Result<(), CutError> {
        let counts = characteristics(&self.mesh);
        let loops = self.mesh.boundary_loops_of_components();
        for (component, (&euler_characteristic, &boundary_loops)) in counts.iter().zip(&loops).enumerate() {
            if (euler_characteristic, boundary_loops) != (1, 1) {
                let inside = |face: &FaceId| self.mesh.component(self.mesh.face(*face)[0]) == component;
                let face = self.mesh.face_ids().find(inside).unwrap_or(FaceId(0));
                return Err(CutError::NoDisk { face, euler_characteristic, boundary_loops });
            }
        }
        Ok(())
    }
}

/// The Euler characteristic of each component.
fn characteristics(mesh: &SurfaceMesh) -> Vec<isize> {
    let mut counts = vec![0; mesh.components()];
    for v in mesh.vertex_ids() {
        counts[mesh.component(v)] += 1;
    }
    for edge in mesh.edge_ids() {
        counts[mesh.component(mesh.ends(edge)[0])] -= 1;
    }
    for face in mesh.face_ids() {
        counts[mesh.component(mesh.face(face)[0])] += 1;
    }
    counts
}

/// Opens a surface along a set of edges, which may form paths, trees and loops.
///
/// # Definition
/// Two corners of adjacent faces at the same vertex stay together unless the edge between the faces is cut. Each class of corners
/// becomes a vertex: an inner vertex with k cut edges has max(1, k) copies, a boundary vertex k + 1. Boundary edges may be listed,
/// and have no effect. The operation is combinatorial, so the result is exact.
///
/// # Errors
/// [`CutError::SingleEdge`] for a cut edge neither of whose ends is split: both of its sides would join the same two vertices, and
/// a triangle mesh cannot represent that.
///
/// # Cost
/// O(F).
pub fn open(mesh: &SurfaceMesh, cut: &EdgeData<bool>) -> Result<Opened, CutError> {
    let mut corners = vec![0_u32; mesh.halfedges()];
    let mut vertex_map: Vec<VertexId> = mesh.vertex_ids().collect();
    let mut fan: Vec<HalfedgeId> = Vec::new();
    for v in mesh.vertex_ids() {
        fan.clear();
        fan.extend(mesh.outgoing(v));
        let is_cut = |h: HalfedgeId| cut[mesh.edge(h)];
        if !mesh.is_boundary_vertex(v) {
            // A new fan begins at each cut edge.
            let first = fan.iter().position(|&h| is_cut(h)).unwrap_or(0);
            fan.rotate_left(first);
        }
        let mut copy = v.0;
        for (i, &h) in fan.iter().enumerate() {
            if i > 0 && is_cut(h) {
                copy = vertex_map.len() as u32;
                vertex_map.push(v);
            }
            corners[h.index()] = copy;
        }
    }
    let faces: Vec<[u32; 3]> = corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
    let whole =
        |edge: &_| cut[*edge] && !mesh.is_boundary_edge(*edge) && is_closed_again(mesh, &corners, *edge);
    if let Some(edge) = mesh.edge_ids().find(whole) {
        return Err(CutError::SingleEdge { ends: mesh.ends(edge) });
    }
    let opened = SurfaceMesh::from_faces(vertex_map.len(), &faces)?;
    Ok(Opened {
        mesh: opened,
        faces,
        vertex_map: VertexData::from_fn(vertex_map.len(), |v: VertexId| vertex_map[v.index()]),
    })
}

/// Whether both sides of an edge have the same two vertices.
fn is_closed_again(mesh: &SurfaceMesh, corners: &[u32], edge: pompeiu_surface::EdgeId) -> bool {
    let h = mesh.edge_halfedge(edge);
    mesh.twin(h).is_some_and(|twin| {
        corners[h.index()] == corners[twin.next().index()]
            && corners[h.next().index()] == corners[twin.index()]
    })
}
