//! The pair of points that proves a lower bound.

use super::Direction;
use pompeiu_core::{FaceId, TriMesh};

/// A point on a face of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SurfacePoint {
    /// The face.
    pub face: FaceId,
    /// Nonnegative weights of the corners. The point meant is `sum(w_i v_i) / sum(w_i)` in exact arithmetic; the sum
    /// differs from 1 by rounding at most.
    pub barycentric: [f64; 3],
    /// That point, rounded.
    pub position: [f64; 3],
}

impl SurfacePoint {
    pub(crate) fn new(mesh: &TriMesh, face: FaceId, barycentric: [f64; 3]) -> Self {
        let corners = mesh.corners(face);
        let position = [0, 1, 2].map(|k| (0..3).map(|i| barycentric[i] * corners[i][k]).sum());
        Self { face, barycentric, position }
    }
}

/// A point that is far from the other mesh, and a point of that mesh nearest to it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Witness {
    /// On the mesh that distances are measured from.
    pub from: SurfacePoint,
    /// On the mesh that distances are measured to. Its barycentric coordinates refer to the face as seen in the frame of
    /// the search, so its position is rounded once more where that frame is shifted.
    pub to: SurfacePoint,
}

impl Witness {
    /// The two points by the meshes they lie on, for a witness of this direction.
    pub fn by_mesh(&self, direction: Direction) -> PointPair {
        match direction {
            Direction::AToB => PointPair { a: self.from, b: self.to },
            Direction::BToA => PointPair { a: self.to, b: self.from },
        }
    }
}

/// Two points, each named by the mesh it lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PointPair {
    /// On mesh A.
    pub a: SurfacePoint,
    /// On mesh B.
    pub b: SurfacePoint,
}
