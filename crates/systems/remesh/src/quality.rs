//! How good the triangles of a mesh are.

use super::connectivity::{ConnectivityError, DynamicMesh};
use super::isotropic::{LONGEST, SHORTEST};
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};

/// Least, mean and greatest of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Range {
    /// The least value.
    pub least: f64,
    /// The mean.
    pub mean: f64,
    /// The greatest value.
    pub greatest: f64,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut least, mut greatest, mut sum, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
        for x in values {
            least = if x < least { x } else { least };
            greatest = if x > greatest { x } else { greatest };
            sum += x;
            count += 1.0;
        }
        Self { least, mean: sum / count, greatest }
    }
}

/// The quality of the triangles of a mesh. Lengths are in its unit, angles in degrees, shares between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Quality {
    /// Number of vertices that are in a face.
    pub vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of faces.
    pub faces: usize,
    /// Lengths of edges.
    pub edge_length: Range,
    /// The least angle of each face.
    pub least_angle: Range,
    /// The greatest angle of all.
    pub greatest_angle: f64,
    /// Share of vertices with 6 neighbours, or 4 at the boundary.
    pub regular: f64,
    /// Share of vertices whose number of neighbours differs from that by at most 1.
    pub nearly_regular: f64,
    /// Share of edges between 4/5 and 4/3 of their target length; none for a mesh that had no target.
    pub near_target: Option<f64>,
}

impl Quality {
    /// Measures a mesh.
    ///
    /// # Errors
    /// [`ConnectivityError`] if the faces are no oriented manifold.
    pub fn of(mesh: &TriMesh) -> Result<Self, ConnectivityError> {
        let frame = Frame::of(&Aabb::of_faces(mesh));
        let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
        dynamic.map_positions(|p| frame.map(p));
        Ok(Self::in_frame(&dynamic, &frame, None))
    }

    /// Measures a surface in a frame; `shares` are the lengths of edges as shares of their targets.
    pub(super) fn in_frame(mesh: &DynamicMesh, frame: &Frame, shares: Option<&[f64]>) -> Self {
        let lengths: Vec<f64> = mesh
            .edges()
            .map(|h| [mesh.from(h), mesh.to(h)].map(|v| mesh.positions[v as usize]))
            .map(|[p, q]| frame.length_out(p.distance(q)))
            .collect();
        let faces = (0..mesh.halfedge_slots() / 3).filter(|&f| mesh.exists(3 * f));
        let angles: Vec<[f64; 3]> =
            faces.map(|f| angles(mesh.corners(f).map(|v| mesh.positions[v as usize]))).collect();
        let valences = (0..mesh.positions.len() as u32).filter(|&v| mesh.has_faces(v));
        let excess: Vec<usize> =
            valences.map(|v| mesh.neighbours(v).count().abs_diff(mesh.regular_valence(v))).collect();
        let share = |most: usize| excess.iter().filter(|&&x| x <= most).count() as f64 / excess.len() as f64;
        let fits = |x: &&f64| (SHORTEST..=LONGEST).contains(*x);
        Self {
            vertices: excess.len(),
            edges: lengths.len(),
            faces: mesh.face_count(),
            edge_length: Range::of(lengths.iter().copied()),
            least_angle: Range::of(angles.iter().map(|a| a.iter().copied().fold(180.0, f64::min))),
            greatest_angle: angles.iter().flatten().copied().fold(0.0, f64::max),
            regular: share(0),
            nearly_regular: share(1),
            near_target: shares.map(|s| s.iter().filter(fits).count() as f64 / s.len() as f64),
        }
    }
}

/// The angles of a triangle in degrees; 0 where two corners are at one position.
pub fn angles(corners: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let [p, q, r] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
        let (a, b) = ((q - p).normalize_or_zero(), (r - p).normalize_or_zero());
        libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
    })
}
