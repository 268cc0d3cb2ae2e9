//! Options for drawing pieces.

use super::Print;
use crate::Packing;

/// Options for drawing pieces.
#[derive(Clone, Copy, Debug, Default)]
pub struct PieceDrawing<'p> {
    /// Exploded view: additional displacement of each piece from the centre, relative to its distance from there; 0 leaves pieces
    /// in place.
    pub pull: f64,
    /// Where pieces lie on a sheet, instead of in place or pulled apart.
    pub packing: Option<&'p Packing>,
    /// The width of the cut. If positive, the paths of pieces that are pulled apart or packed are offset outwards by half of it, so that
    /// pieces have their nominal size after cutting; pieces are pulled at least so far apart that no two paths meet. In place, paths are
    /// those of the pieces.
    pub kerf: f64,
    /// A picture printed on the pieces, for SVG.
    pub print: Option<&'p Print>,
}
