//! Errors of hexahedral meshes.

/// Why cells do not form a valid mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// A cell names a vertex that does not exist.
    #[error("cell {cell} names vertex {index}, but there are {vertices} vertices (the first is 0)")]
    Index {
        /// The cell.
        cell: usize,
        /// The index it holds.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A cell names a vertex twice.
    #[error("cell {cell} has vertex {index} at two corners")]
    Repeated {
        /// The cell.
        cell: usize,
        /// The vertex.
        index: u32,
    },
    /// A coordinate is not finite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// More than two cells share a face, or two lie on the same side of it.
    #[error("cells {} and {} meet at a face wrongly: more than two cells share it, or two lie on one side", cells[0], cells[1])]
    NotConforming {
        /// Two of the cells.
        cells: [usize; 2],
    },
}
