//! Why a shape cannot be made.

use crate::mesh::MeshError;

/// Why parameters do not describe a shape.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A length or radius is zero, negative, infinite or NaN.
    #[error("the {what} must be a finite number above zero, but it is {value}")]
    Size {
        /// Which parameter.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A count is too small to close the shape.
    #[error("the number of {what} must be at least {least}, but it is {count}")]
    TooFew {
        /// Which parameter.
        what: &'static str,
        /// Its value.
        count: u32,
        /// The least that works.
        least: u32,
    },
    /// A surface can be spanned on one or two polygons.
    #[error("there are {count} polygons; a surface is spanned on 1 or 2")]
    Loops {
        /// How many there are.
        count: usize,
    },
    /// More vertices or faces than 32-bit indices can name.
    #[error("the shape would have {count} {what}; at most {} are supported", u32::MAX)]
    TooMany {
        /// `"vertices"` or `"faces"`.
        what: &'static str,
        /// Their number, or [`u64::MAX`] if it is larger still.
        count: u64,
    },
    /// The arrays do not fit in memory.
    #[error("there is no memory for {vertices} vertices and {faces} faces")]
    NoMemory {
        /// Number of vertices.
        vertices: u64,
        /// Number of faces.
        faces: u64,
    },
    /// The result is not a usable mesh, for example because its coordinates are too large.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
