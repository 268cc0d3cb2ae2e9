//! Why cells make no mesh.

/// Why cells make no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// A vertex that does not exist.
    #[error("cell {cell} names vertex {index}, but there are {vertices} vertices (the first is 0)")]
    Index {
        /// The cell.
        cell: usize,
        /// The index it holds.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A vertex twice in one cell.
    #[error("cell {cell} has vertex {index} at two corners")]
    Repeated {
        /// The cell.
        cell: usize,
        /// The vertex.
        index: u32,
    },
    /// A coordinate that is not finite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A face of more than two cells, or of two on the same side.
    #[error("cells {} and {} meet at a face wrongly: more than two cells share it, or two lie on one side", cells[0], cells[1])]
    NotConforming {
        /// Two of the cells.
        cells: [usize; 2],
    },
}
