//! The output of format readers before validation.

use crate::groups::Group;
use crate::polygon::Polygon;

/// Positions and triangles as stated by a file, and the changes made to them.
#[derive(Debug, Default)]
pub(crate) struct RawMesh {
    /// Vertex positions in file order.
    pub(crate) positions: Vec<[f64; 3]>,
    /// Triangles; indices below `positions.len()`.
    pub(crate) faces: Vec<[u32; 3]>,
    /// The faces of the file with more than three corners, in the order of `faces`. They are stored there as fans about their first
    /// corner until [`triangulate`](crate::polygon::triangulate) has chosen better triangles.
    pub(crate) polygons: Vec<Polygon>,
    /// Faces with fewer than three corners (points, lines) that were omitted.
    pub(crate) faces_dropped: u64,
    /// Named groups.
    pub(crate) groups: Vec<Group>,
}

impl RawMesh {
    /// Adds one face of the file with any number of corners.
    pub(crate) fn push_polygon(&mut self, corners: impl IntoIterator<Item = u32>) {
        let start = self.faces.len();
        let mut corners = corners.into_iter();
        if let Some((first, mut previous)) = corners.next().zip(corners.next()) {
            for corner in corners {
                self.faces.push([first, previous, corner]);
                previous = corner;
            }
        }
        match self.faces.len() - start {
            0 => self.faces_dropped += 1,
            1 => {}
            triangles => self.polygons.push(Polygon { first: start as u32, corners: triangles as u32 + 2 }),
        }
    }
}
