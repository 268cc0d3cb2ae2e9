//! Surfaces in space: frames and normals.

use crate::plane::Vec2;
use crate::surface::{FlatFace, LEAST_HEIGHT};
use crate::{GeometryError, Surface, SurfaceMesh};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_core::{FaceId, TriMesh};

/// A vector in space.
type Vec3 = [f64; 3];

/// A [`Surface`] whose vertices have positions in space, and each face a frame: two unit tangents and the normal.
///
/// The first tangent runs along the face's first edge, the second is a quarter turn from it, counter-clockwise seen from
/// the side that the normal points to.
///
/// # Shapes and units
/// 72 bytes per face and 24 per vertex beside the [`Surface`].
#[derive(Clone, Debug, PartialEq)]
pub struct EmbeddedSurface {
    surface: Surface,
    positions: VertexData<Vec3>,
    frames: FaceData<[Vec3; 3]>,
}

impl EmbeddedSurface {
    /// The surface that a mesh describes.
    ///
    /// # Accuracy
    /// Lengths and heights are computed from differences of corners and their cross product: relative errors of a few rounding
    /// units, divided by the sine of the angle for thin faces.
    /// # Errors
    /// [`GeometryError`]: the mesh is not an oriented manifold, or a face is degenerate.
    /// # Cost
    /// O(F).
    pub fn new(mesh: &TriMesh) -> Result<Self, GeometryError> {
        let connectivity = SurfaceMesh::new(mesh)?;
        let flat = FlatFace { length: 0.0, apex: [0.0; 2] };
        let mut faces = FaceData::filled(mesh.faces().len(), flat);
        let frames = FaceData::try_from_fn(mesh.faces().len(), |face| {
            let [a, b, c] = mesh.corners(face);
            let (u, v) = (sub(b, a), sub(c, a));
            let length = dot(u, u).sqrt();
            let normal = cross(u, v);
            let twice_area = dot(normal, normal).sqrt();
            if twice_area == 0.0 {
                // There may be no first edge, and so no frame.
                let lengths = [u, sub(c, b), v].map(|side| dot(side, side).sqrt());
                return Err(GeometryError::DegenerateFace {
                    face,
                    lengths,
                    height: 0.0,
                    least: LEAST_HEIGHT,
                });
            }
            let first = u.map(|x| x / length);
            let normal = normal.map(|x| x / twice_area);
            faces[face] = FlatFace { length, apex: [dot(first, v), twice_area / length] };
            Ok([first, cross(normal, first), normal])
        })?;
        let surface = Surface::from_flat_faces(connectivity, faces)?;
        let positions = VertexData::from_fn(mesh.positions().len(), |v| mesh.positions()[v.index()]);
        Ok(Self { surface, positions, frames })
    }

    /// The intrinsic geometry.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The connectivity.
    pub fn mesh(&self) -> &SurfaceMesh {
        self.surface.mesh()
    }

    /// The positions of all vertices.
    pub fn positions(&self) -> &VertexData<Vec3> {
        &self.positions
    }

    /// The positions of the corners of a face.
    #[inline]
    pub fn corner_positions(&self, face: FaceId) -> [Vec3; 3] {
        self.mesh().face(face).map(|v| self.positions[v])
    }

    /// The mean of the corners of a face.
    pub fn centroid(&self, face: FaceId) -> Vec3 {
        let corners = self.corner_positions(face);
        [0, 1, 2].map(|i| corners.iter().map(|p| p[i] / 3.0).sum())
    }

    /// First tangent, second tangent and normal of a face, of length one.
    pub fn frame(&self, face: FaceId) -> &[Vec3; 3] {
        &self.frames[face]
    }

    /// The unit normals of all faces.
    pub fn face_normals(&self) -> FaceData<Vec3> {
        self.frames.map(|frame| frame[2])
    }

    /// The normals of vertices: the mean of the faces around, weighted by angle; zero where they cancel.
    pub fn vertex_normals(&self) -> VertexData<Vec3> {
        VertexData::from_fn(self.mesh().vertices(), |v| {
            let mut sum = [0.0; 3];
            for h in self.mesh().outgoing(v) {
                let angle = self.surface.angle(h);
                let normal = self.frames[h.face()][2];
                for i in 0..3 {
                    sum[i] += angle * normal[i];
                }
            }
            let length = dot(sum, sum).sqrt();
            if length > 0.0 { sum.map(|x| x / length) } else { [0.0; 3] }
        })
    }

    /// A tangent vector of a face as a vector in space.
    #[inline]
    pub fn to_space(&self, face: FaceId, tangent: Vec2) -> Vec3 {
        let [first, second, _] = self.frame(face);
        [0, 1, 2].map(|i| tangent[0] * first[i] + tangent[1] * second[i])
    }

    /// The part of a vector in space that is tangent to a face, in the frame of the face.
    #[inline]
    pub fn to_tangent(&self, face: FaceId, vector: Vec3) -> Vec2 {
        let [first, second, _] = self.frame(face);
        [dot(*first, vector), dot(*second, vector)]
    }
}

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}
