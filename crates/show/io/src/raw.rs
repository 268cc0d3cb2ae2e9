//! What every format reader returns before validation.

use crate::groups::Group;
use crate::polygon::Polygon;

/// Positions and triangles as a file states them, and what had to be changed on the way.
#[derive(Debug, Default)]
pub(crate) struct RawMesh {
    /// Vertex positions in file order.
    pub(crate) positions: Vec<[f64; 3]>,
    /// Triangles; indices below `positions.len()`.
    pub(crate) faces: Vec<[u32; 3]>,
    /// The faces of the file with more than three corners; they stand in `faces` as fans about their first corner
    /// until [`triangulate`](crate::polygon::triangulate) has chosen better triangles. In the order of `faces`.
    pub(crate) polygons: Vec<Polygon>,
    /// Faces with fewer than three corners (points, lines) that were left out.
    pub(crate) faces_dropped: u64,
    /// What the file gives names to.
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
