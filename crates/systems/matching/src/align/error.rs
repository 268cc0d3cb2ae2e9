//! Errors of alignment.

/// Why a mesh cannot be aligned.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlignError {
    /// A mesh of points or segments has no centroid of its area.
    #[error("no face (of {faces}) has an area, so there is nothing to align by")]
    NoArea {
        /// Faces of the mesh.
        faces: usize,
    },
    /// The map leaves the range of double precision.
    #[error("the sizes or places of the two meshes are too far apart to align them in double precision")]
    Sizes,
    /// The overlap is not a valid share of the area.
    #[error("the overlap is {0}; it must be a share of the area above 0 and at most 1")]
    Overlap(f64),
}
