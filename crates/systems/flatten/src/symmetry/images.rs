//! Mirror images of vertices.

use super::{SymmetryError, SymmetryPlane};
use crate::cut::edge_between;
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceMesh};
use std::cmp::Ordering;

/// Largest distance of a mirror image from the nearest vertex, relative to the diagonal of the bounding box: the rounding of files
/// with six digits.
const TOLERANCE: f64 = 1e-5;

/// The mirror images of the vertices and edges of a surface.
#[derive(Clone, Debug)]
pub(crate) struct Images {
    vertices: VertexData<VertexId>,
    /// `Greater` on the side that the normal points to, `Equal` on the plane.
    sides: VertexData<Ordering>,
    edges: EdgeData<Option<EdgeId>>,
}

impl Images {
    /// Finds the mirror images of a surface's vertices. Edges may have none: faces on both sides may be divided differently.
    pub(crate) fn new(surface: &EmbeddedSurface, plane: &SymmetryPlane) -> Result<Self, SymmetryError> {
        let mesh = surface.mesh();
        let of_plane = || SymmetryError::Plane { normal: plane.normal, offset: plane.offset };
        let normal = DVec3::from_array(plane.normal);
        let unit = normal.try_normalize().ok_or_else(of_plane)?;
        let offset = plane.offset / normal.length();
        if !offset.is_finite() {
            return Err(of_plane());
        }
        let points: Vec<DVec3> = surface.positions().iter().map(|&p| DVec3::from_array(p)).collect();
        let most = TOLERANCE * Aabb::of_points(surface.positions().as_slice()).diagonal();
        let heights: Vec<f64> = points.iter().map(|p| unit.dot(*p) - offset).collect();
        // A direction parallel to the plane, in general position: a point and its mirror image have the same key.
        let across = unit.any_orthonormal_vector();
        let along = libm::cos(1.0) * across + libm::sin(1.0) * unit.cross(across);
        let mut order: Vec<(f64, u32)> =
            points.iter().enumerate().map(|(v, p)| (along.dot(*p), v as u32)).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let image = |v: VertexId| {
            let (p, height) = (points[v.index()], heights[v.index()]);
            let there = p - 2.0 * height * unit;
            let key = along.dot(p);
            let first = order.partition_point(|(k, _)| *k < key - most);
            let near = order[first..].iter().take_while(|(k, _)| *k <= key + most);
            let distances = near.map(|&(_, w)| (points[w as usize].distance(there), VertexId(w)));
            let best = distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let (distance, w) = best.unwrap_or((f64::INFINITY, v));
            if distance <= most {
                return Ok(w);
            }
            let distances = points.iter().map(|q| q.distance(there));
            let distance = distances.fold(f64::INFINITY, |least, d| if d < least { d } else { least });
            Err(SymmetryError::NoImage { vertex: v, distance, most })
        };
        let found = mesh.vertex_ids().map(image).collect::<Result<Vec<_>, _>>()?;
        let vertices = VertexData::from_fn(found.len(), |v: VertexId| found[v.index()]);
        if let Some(v) = mesh.vertex_ids().find(|&v| vertices[vertices[v]] != v) {
            // Two vertices at the same position.
            let distance = points[v.index()].distance(points[vertices[vertices[v]].index()]);
            return Err(SymmetryError::NoImage { vertex: v, distance, most });
        }
        let side = |v: VertexId| {
            if vertices[v] == v { Ordering::Equal } else { heights[v.index()].total_cmp(&0.0) }
        };
        let sides = VertexData::from_fn(vertices.len(), side);
        let is_across = |corners: [VertexId; 3]| {
            let on = |side: Ordering| corners.iter().any(|&v| sides[v] == side);
            on(Ordering::Greater) == on(Ordering::Less)
        };
        if let Some(face) = mesh.face_ids().find(|&face| is_across(mesh.face(face))) {
            return Err(SymmetryError::Across { face });
        }
        let edge = |edge| edge_between(mesh, mesh.ends(edge).map(|v| vertices[v]));
        let edges = EdgeData::from_fn(mesh.edges(), edge);
        Ok(Self { vertices, sides, edges })
    }

    /// The mirror image of a vertex.
    pub(crate) fn of(&self, v: VertexId) -> VertexId {
        self.vertices[v]
    }

    /// The mirror image of an edge, if it is an edge.
    pub(crate) fn of_edge(&self, edge: EdgeId) -> Option<EdgeId> {
        self.edges[edge]
    }

    pub(super) fn side(&self, v: VertexId) -> Ordering {
        self.sides[v]
    }

    /// On which side a face lies.
    pub(super) fn side_of(&self, corners: [VertexId; 3]) -> Ordering {
        let sides = corners.map(|v| self.side(v));
        sides.into_iter().find(|side| *side != Ordering::Equal).unwrap_or(Ordering::Equal)
    }

    /// The vertex itself, or its mirror image if that is on the side of the normal.
    pub(super) fn on_first_side(&self, v: VertexId) -> VertexId {
        if self.side(v) == Ordering::Less { self.of(v) } else { v }
    }

    /// Whether an edge lies in the plane.
    pub(super) fn is_on_plane(&self, mesh: &SurfaceMesh, edge: EdgeId) -> bool {
        mesh.ends(edge).into_iter().all(|v| self.side(v) == Ordering::Equal)
    }
}
