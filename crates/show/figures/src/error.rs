//! Why a figure cannot be drawn.

use crate::ScaleError;
use thiserror::Error;

/// Largest number of pixels on a side.
pub(crate) const MAX_SIDE: u32 = 1 << 14;

/// Why a figure cannot be drawn.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FigureError {
    /// A side of the picture is zero or too long.
    #[error("a picture has 1 to {} pixels on a side, but {width} × {height} were asked for", MAX_SIDE)]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The number of values or normals does not match the mesh.
    #[error("a mesh with {expected} {of} needs as many {what}, but has {found}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
        /// The element that each belongs to.
        of: &'static str,
    },
    /// A direction of the view is zero, or not finite.
    #[error("the direction {what} is ({}, {}, {}), which is no direction", direction[0], direction[1], direction[2])]
    Direction {
        /// Which direction.
        what: &'static str,
        /// What was given.
        direction: [f64; 3],
    },
    /// A panel has values, but the figure has no scale.
    #[error("panel {panel} has values, but the figure has no colour scale for them")]
    NoScale {
        /// The panel, counted from 1.
        panel: usize,
    },
    /// The scale is invalid.
    #[error(transparent)]
    Scale(#[from] ScaleError),
}
