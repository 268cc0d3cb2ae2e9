//! Intrinsic geometry: the shape of each face.

use crate::plane::{Rotation, Vec2, cross, dot, norm, sub};
use crate::{CornerData, EdgeData, EdgeId, GeometryError, HalfedgeId, SurfaceMesh};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_core::{FaceId, VertexId};

/// Smallest supported ratio of a face's height to its longest edge. Below it, rounding changes the height that is computed from the
/// corners, by a few units of `2^-53`, by more than a thousandth.
pub(crate) const LEAST_HEIGHT: f64 = 1.0 / (1_u64 << 40) as f64;

/// Least and greatest length of an edge, so that squared areas and their inverses neither overflow nor underflow.
pub(crate) const LENGTHS: [f64; 2] = [1e-60, 1e60];

/// A face in its frame: corner 0 at the origin, corner 1 at `(length, 0)`, corner 2 at `apex` with `apex[1] > 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FlatFace {
    pub(crate) length: f64,
    pub(crate) apex: Vec2,
}

impl FlatFace {
    /// From the lengths of edges 0→1, 1→2, 2→0.
    ///
    /// # Source
    /// `kahan_miscalculating_2014`: Heron's formula in an order of operations that avoids cancellation.
    pub(crate) fn from_lengths(lengths: [f64; 3]) -> Self {
        let [c, a, b] = lengths;
        let mut sorted = lengths;
        sorted.sort_unstable_by(|x, y| y.total_cmp(x));
        let [p, q, r] = sorted;
        let squared = (p + (q + r)) * (r - (p - q)) * (r + (p - q)) * (p + (q - r));
        // Negative or NaN where the lengths violate the triangle inequality; the check of the face reports it.
        let height = squared.sqrt() / (2.0 * c);
        Self { length: c, apex: [((b - a) * (b + a) + c * c) / (2.0 * c), height] }
    }

    #[inline]
    pub(crate) fn corner(&self, i: usize) -> Vec2 {
        match i {
            0 => [0.0, 0.0],
            1 => [self.length, 0.0],
            _ => self.apex,
        }
    }

    /// The vector from corner `i` to the next.
    #[inline]
    pub(crate) fn side(&self, i: usize) -> Vec2 {
        match i {
            0 => [self.length, 0.0],
            1 => [self.apex[0] - self.length, self.apex[1]],
            _ => [-self.apex[0], -self.apex[1]],
        }
    }

    pub(crate) fn check(self, face: FaceId) -> Result<Self, GeometryError> {
        let lengths = [0, 1, 2].map(|i| norm(self.side(i)));
        let longest = lengths.into_iter().fold(0.0, |m, x| if x > m { x } else { m });
        let height = self.length / longest * (self.apex[1] / longest);
        let [least, most] = LENGTHS;
        let shortest = lengths.into_iter().fold(longest, |m, x| if x < m { x } else { m });
        if longest > 0.0 && (longest > most || (shortest < least && height >= LEAST_HEIGHT)) {
            return Err(GeometryError::Scale { face, length: longest, least, most });
        }
        if height >= LEAST_HEIGHT {
            Ok(self)
        } else {
            let height = if height > 0.0 { height } else { 0.0 };
            Err(GeometryError::DegenerateFace { face, lengths, height, least: LEAST_HEIGHT })
        }
    }
}

/// An oriented manifold triangle surface with intrinsic geometry (lengths, angles, areas) but without positions in space.
///
/// Each face is a flat triangle in a frame of its own: its corner 0 is at the origin and its corner 1 on the first axis.
/// Tangent vectors of a face are pairs of coordinates in that frame.
///
/// # Shapes and units
/// Lengths are in a unit of the caller's, between 1e-60 and 1e60. 24 bytes per face beside the connectivity.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    mesh: SurfaceMesh,
    faces: FaceData<FlatFace>,
}

impl Surface {
    /// The surface with these edge lengths, whether or not it can be embedded in space.
    ///
    /// # Errors
    /// [`GeometryError::LengthCount`]; [`GeometryError::DegenerateFace`] for a face whose lengths violate the triangle inequality,
    /// or one that is too thin; [`GeometryError::Scale`].
    ///
    /// # Source
    /// `kahan_miscalculating_2014` for heights from lengths.
    pub fn from_edge_lengths(mesh: SurfaceMesh, lengths: &EdgeData<f64>) -> Result<Self, GeometryError> {
        if lengths.len() != mesh.edges() {
            return Err(GeometryError::LengthCount { found: lengths.len(), expected: mesh.edges() });
        }
        let faces = FaceData::try_from_fn(mesh.faces(), |face| {
            let lengths = SurfaceMesh::face_halfedges(face).map(|h| lengths[mesh.edge(h)]);
            let proper = lengths.into_iter().all(|length| length > 0.0 && length.is_finite());
            let flat = FlatFace::from_lengths(lengths);
            if proper && flat.apex[1] > 0.0 {
                flat.check(face)
            } else {
                let least = LEAST_HEIGHT;
                Err(GeometryError::DegenerateFace { face, lengths, height: 0.0, least })
            }
        })?;
        Ok(Self { mesh, faces })
    }

    pub(crate) fn from_flat_faces(
        mesh: SurfaceMesh,
        faces: FaceData<FlatFace>,
    ) -> Result<Self, GeometryError> {
        for (face, flat) in faces.entries() {
            flat.check(face)?;
        }
        Ok(Self { mesh, faces })
    }

    /// The connectivity.
    pub fn mesh(&self) -> &SurfaceMesh {
        &self.mesh
    }

    #[inline]
    pub(crate) fn flat(&self, face: FaceId) -> &FlatFace {
        &self.faces[face]
    }

    /// The corners of a face in its frame.
    pub fn corners(&self, face: FaceId) -> [Vec2; 3] {
        [0, 1, 2].map(|i| self.flat(face).corner(i))
    }

    /// The vector along a half-edge, in the frame of its face.
    #[inline]
    pub fn vector(&self, halfedge: HalfedgeId) -> Vec2 {
        self.flat(halfedge.face()).side(halfedge.corner())
    }

    /// The three sides of a face as vectors in its frame, from each corner to the next; they add up to zero.
    #[inline]
    pub fn sides(&self, face: FaceId) -> [Vec2; 3] {
        [0, 1, 2].map(|i| self.flat(face).side(i))
    }

    /// The area of a face.
    #[inline]
    pub fn face_area(&self, face: FaceId) -> f64 {
        let flat = self.flat(face);
        0.5 * flat.length * flat.apex[1]
    }

    /// The least height of a face over its longest edge: √3/2 for an equilateral one, near zero for a thin one.
    pub fn relative_height(&self, face: FaceId) -> f64 {
        let flat = self.flat(face);
        let longest =
            [0, 1, 2].map(|i| norm(flat.side(i))).into_iter().fold(0.0, |m, x| if x > m { x } else { m });
        flat.length / longest * (flat.apex[1] / longest)
    }

    /// The areas of all faces.
    pub fn face_areas(&self) -> FaceData<f64> {
        FaceData::from_fn(self.mesh.faces(), |face| self.face_area(face))
    }

    /// The area of the surface.
    pub fn area(&self) -> f64 {
        self.mesh.face_ids().map(|face| self.face_area(face)).sum()
    }

    /// A third of the area of the faces around each vertex: the lumped mass matrix of continuous linear functions.
    pub fn vertex_areas(&self) -> VertexData<f64> {
        let mut areas = VertexData::filled(self.mesh.vertices(), 0.0);
        for face in self.mesh.face_ids() {
            let third = self.face_area(face) / 3.0;
            for v in self.mesh.face(face) {
                areas[v] += third;
            }
        }
        areas
    }

    /// A third of the area of the faces along each edge: the mass matrix of Crouzeix–Raviart functions, which is diagonal
    /// without lumping.
    pub fn edge_areas(&self) -> EdgeData<f64> {
        let mut areas = EdgeData::filled(self.mesh.edges(), 0.0);
        for face in self.mesh.face_ids() {
            let third = self.face_area(face) / 3.0;
            for h in SurfaceMesh::face_halfedges(face) {
                areas[self.mesh.edge(h)] += third;
            }
        }
        areas
    }

    /// The length of an edge, measured in the face of its first half-edge.
    pub fn edge_length(&self, edge: EdgeId) -> f64 {
        norm(self.vector(self.mesh.edge_halfedge(edge)))
    }

    /// The lengths of all edges.
    pub fn edge_lengths(&self) -> EdgeData<f64> {
        EdgeData::from_fn(self.mesh.edges(), |edge| self.edge_length(edge))
    }

    /// The cotangent of the angle at a corner, the one where the half-edge starts.
    #[inline]
    pub fn cotangent(&self, corner: HalfedgeId) -> f64 {
        let flat = self.flat(corner.face());
        let out = flat.side(corner.corner());
        let back = flat.side(corner.previous().corner());
        -dot(out, back) / (flat.length * flat.apex[1])
    }

    /// The angle at a corner, the one where the half-edge starts, in radians.
    pub fn angle(&self, corner: HalfedgeId) -> f64 {
        let flat = self.flat(corner.face());
        let out = flat.side(corner.corner());
        let back = flat.side(corner.previous().corner());
        libm::atan2(flat.length * flat.apex[1], -dot(out, back))
    }

    /// The angles at all corners, in radians.
    pub fn angles(&self) -> CornerData<f64> {
        CornerData::from_fn(self.mesh.halfedges(), |corner| self.angle(corner))
    }

    /// The sum of the angles at a vertex, in radians.
    pub fn total_angle(&self, vertex: VertexId) -> f64 {
        self.mesh.outgoing(vertex).map(|h| self.angle(h)).sum()
    }

    /// The angle defect of each vertex: 2π less the sum of its angles, π less the sum at the boundary.
    ///
    /// They add up to 2π times the Euler characteristic (Gauss and Bonnet), whatever the shape.
    pub fn angle_defects(&self) -> VertexData<f64> {
        use std::f64::consts::{PI, TAU};
        let flat = |v| if self.mesh.is_boundary_vertex(v) { PI } else { TAU };
        VertexData::from_fn(self.mesh.vertices(), |v| flat(v) - self.total_angle(v))
    }

    /// The rotation from the frame of a half-edge's face to the frame of its twin's face, with the two faces unfolded into a plane
    /// about their common edge. `None` at the boundary.
    ///
    /// This is parallel transport across an edge (the Levi-Civita connection).
    pub fn transport(&self, halfedge: HalfedgeId) -> Option<Rotation> {
        let twin = self.mesh.twin(halfedge)?;
        let (here, there) = (self.vector(halfedge), self.vector(twin));
        // The twin runs in the opposite direction.
        let back = [-there[0], -there[1]];
        let length = norm(here) * norm(back);
        Some([dot(here, back) / length, cross(here, back) / length])
    }

    /// The point with these barycentric coordinates, in the frame of its face.
    pub fn point(&self, face: FaceId, barycentric: [f64; 3]) -> Vec2 {
        let flat = self.flat(face);
        [barycentric[1] * flat.length + barycentric[2] * flat.apex[0], barycentric[2] * flat.apex[1]]
    }

    /// The barycentric coordinates of a point given in the frame of a face; they add up to one.
    pub fn barycentric(&self, face: FaceId, point: Vec2) -> [f64; 3] {
        let flat = self.flat(face);
        let twice = flat.length * flat.apex[1];
        let third = point[1] / flat.apex[1];
        let second = cross(point, flat.apex) / twice;
        [cross(sub(flat.corner(1), point), sub(flat.apex, point)) / twice, second, third]
    }
}
