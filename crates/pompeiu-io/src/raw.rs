//! What every format reader returns before validation.

/// Positions and triangles as a file states them, and what had to be changed on the way.
#[derive(Debug, Default)]
pub(crate) struct RawMesh {
    /// Vertex positions in file order.
    pub(crate) positions: Vec<[f64; 3]>,
    /// Triangles; indices below `positions.len()`.
    pub(crate) faces: Vec<[u32; 3]>,
    /// Faces with more than three corners that were triangulated.
    pub(crate) polygons_triangulated: u64,
    /// Faces with fewer than three corners (points, lines) that were left out.
    pub(crate) faces_dropped: u64,
}
