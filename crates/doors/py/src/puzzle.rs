//! Drawings of puzzles.

use crate::errors::{Raise, unknown};
use pompeiu::puzzle::{
    PieceDrawing, Print, PuzzleAnswer, cuts_dxf, cuts_svg, motion_png, motion_svg, page, pieces_dxf,
    pieces_png, pieces_svg,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A puzzle that can be drawn.
#[pyclass(frozen)]
pub(crate) struct PuzzleDrawings {
    made: PuzzleAnswer,
    kerf: f64,
}

impl PuzzleDrawings {
    pub(crate) fn new(made: PuzzleAnswer, kerf: f64) -> Self {
        Self { made, kerf }
    }
}

#[pymethods]
impl PuzzleDrawings {
    /// Draws the pieces, the cuts, the motion or a page; nothing where there is no motion.
    fn draw<'py>(
        &self,
        py: Python<'py>,
        what: String,
        suffix: &str,
        pull: f64,
        image: Option<Vec<u8>>,
    ) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let PuzzleAnswer { puzzle, report, motion, .. } = &self.made;
        let print = image.map(|bytes| Print::read(&bytes)).transpose().map_err(Raise::raise)?;
        let (print, kerf) = (print.as_ref(), self.kerf);
        let drawing = PieceDrawing { pull, packing: report.packing.as_ref(), kerf, print };
        let drawn = match (what.as_str(), suffix) {
            ("page", _) => {
                let title = format!("Puzzle of {} pieces", puzzle.pieces());
                page(puzzle, report, motion.as_ref(), print, &title).into_bytes()
            }
            ("motion", suffix) => match motion {
                None => return Ok(None),
                Some(motion) if suffix == "png" => {
                    motion_png(puzzle, motion).map_err(PyValueError::new_err)?
                }
                Some(motion) => motion_svg(puzzle, motion).into_bytes(),
            },
            ("cuts", "dxf") => cuts_dxf(puzzle, kerf).into_bytes(),
            ("cuts", _) => cuts_svg(puzzle, kerf).into_bytes(),
            ("pieces", "png") => pieces_png(puzzle, print).map_err(PyValueError::new_err)?,
            ("pieces", "dxf") => pieces_dxf(puzzle, &drawing).into_bytes(),
            ("pieces", _) => pieces_svg(puzzle, &drawing).into_bytes(),
            _ => return Err(unknown("drawing", what, "\"pieces\", \"cuts\", \"motion\" or \"page\"")),
        };
        Ok(Some(PyBytes::new(py, &drawn)))
    }
}
