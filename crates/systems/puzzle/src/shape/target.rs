//! The requested shape of pieces.

use super::classics::PieceName;
use crate::PuzzleError;
use pompeiu_planar::{Outline, first_crossing, resample};

/// The requested shape of pieces.
#[derive(Clone, Debug, PartialEq)]
pub enum PieceShape {
    /// A built-in shape.
    Built(PieceName),
    /// An outline; its size is ignored.
    Outline(Outline),
}

impl PieceShape {
    /// Its outline.
    ///
    /// # Errors
    /// [`PuzzleError::PieceCrossing`] if it crosses itself.
    pub(crate) fn outline(&self) -> Result<Outline, PuzzleError> {
        let outline = match self {
            Self::Built(name) => name.outline().ok_or(PuzzleError::Narrow { piece: 0 })?,
            Self::Outline(outline) => outline.clone(),
        };
        match first_crossing(&outline) {
            Some(crossing) => {
                Err(PuzzleError::PieceCrossing { sides: crossing.sides, place: crossing.place })
            }
            None => Ok(outline),
        }
    }
}

/// Largest number of corners of a shape: silhouettes of pictures have thousands, whose detail pieces cannot show.
const CORNERS: usize = 240;

/// The shape with area 1 and its centroid at the origin.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    pub(crate) outline: Outline,
}

impl Target {
    pub(crate) fn new(shape: &Outline) -> Self {
        let few = if shape.points().len() > CORNERS {
            Outline::new(resample(shape, CORNERS, 0)).unwrap_or_else(|_| shape.clone())
        } else {
            shape.clone()
        };
        let [x, y] = few.centroid();
        let scale = few.area().sqrt();
        let outline = few.map(|p| [(p[0] - x) / scale, (p[1] - y) / scale]).unwrap_or(few);
        Self { outline }
    }
}
