//! What every format reader returns before validation.

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
}

impl RawMesh {
    /// Adds one face of the file with any number of corners.
    #[allow(dead_code, reason = "the readers to come use it")]
    pub(crate) fn push_polygon(&mut self, corners: &[u32]) {
        let &[first, second, ref rest @ ..] = corners else {
            self.faces_dropped += 1;
            return;
        };
        match rest.len() {
            0 => self.faces_dropped += 1,
            1 => {}
            _ => {
                let first = self.faces.len() as u32;
                self.polygons.push(Polygon { first, corners: corners.len() as u32 });
            }
        }
        let mut previous = second;
        for &corner in rest {
            self.faces.push([first, previous, corner]);
            previous = corner;
        }
    }
}
