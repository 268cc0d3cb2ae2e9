//! Why a flow cannot be computed as asked.

use super::CheckpointError;
use crate::FluidError;
use pompeiu_core::MeshError;
use pompeiu_core::mesh::shapes::ShapeError;
use pompeiu_operators::{ExpressionError, FieldSourceError};
use pompeiu_planar::picture::PictureError;
use std::path::PathBuf;

/// Why a flow cannot be computed as asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FluidRequestError {
    /// The simulation refuses its options, or ends.
    #[error(transparent)]
    Fluid(#[from] FluidError),
    /// The initial velocity cannot be used.
    #[error("velocity: {0}")]
    Velocity(#[from] FieldSourceError),
    /// An expression has no values.
    #[error("{what}: {error}")]
    Expression {
        /// The option, with the name of a density.
        what: String,
        /// What is wrong.
        error: ExpressionError,
    },
    /// A picture cannot be read.
    #[error("{}: {error}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: PictureFailure,
    },
    /// The number of steps, their length, or both are missing.
    #[error("give {0}")]
    Missing(&'static str),
    /// An option is for the square only.
    #[error("`{0}` is for the square; name it with --square, or leave `{0}` out")]
    ForSquare(&'static str),
    /// An option is for surfaces only.
    #[error("`{0}` is for surfaces; in the square leave it out")]
    ForSurface(&'static str),
    /// A mesh and the square, or neither.
    #[error("a flow is on a mesh or in the square, with --square; give one of them")]
    Place,
    /// The square has too few or too many cells.
    #[error("the square has {cells} cells on a side; expected 2 to {most}")]
    Cells {
        /// Cells on a side.
        cells: usize,
        /// The most that are supported.
        most: usize,
    },
    /// The cells of the square cannot be a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The cells of the square cannot be a lattice.
    #[error(transparent)]
    Lattice(#[from] ShapeError),
    /// Two descriptions of the initial flow.
    #[error("both a velocity and a vorticity are given; choose one of them")]
    TwoStarts,
    /// The initial velocity in the square is not two expressions.
    #[error("velocity: expected two expressions with `;` between them, found `{0}`")]
    TwoExpressions(String),
    /// A radius makes no sense.
    #[error("a radius is {0}; it must be finite and above 0")]
    Radius(f64),
    /// A source is neither in a ball nor in a picture.
    #[error("a source of the density \"{0}\" is nowhere; give `at` and `radius`, or a `picture`")]
    Source(String),
    /// A ball touches nothing.
    #[error("{what}: there is no {element} within {radius} of ({}, {}, {})", at[0], at[1], at[2])]
    Nothing {
        /// The table.
        what: &'static str,
        /// The kind of element.
        element: &'static str,
        /// The centre.
        at: [f64; 3],
        /// The radius.
        radius: f64,
    },
    /// The state cannot be resumed.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// More steps are done than were asked for.
    #[error("{done} steps are done already and --steps is {asked}; it counts from the beginning")]
    TooFewSteps {
        /// Steps that are done.
        done: usize,
        /// Steps that were asked for.
        asked: usize,
    },
}

/// Why a picture cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureFailure {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] std::io::Error),
    /// It is no picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
}
