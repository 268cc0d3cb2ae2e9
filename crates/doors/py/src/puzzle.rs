//! Jigsaw puzzles.

use crate::arrays::array_of_rows;
use crate::errors::{Raise, unknown};
use crate::json::written;
use numpy::PyArray2;
use pompeiu::puzzle::{
    Layout, PuzzleOptions, Tab, cuts_dxf, cuts_svg, make, page, pieces_dxf, pieces_svg, report,
};
use pyo3::prelude::*;

/// Outlines of pieces, the report, and the drawings: pieces and cuts as SVG, both as DXF, the page.
type Made<'py> = (Vec<Bound<'py, PyArray2<f64>>>, String, [String; 5]);

/// Makes a puzzle and tests it.
#[pyfunction]
pub(crate) fn puzzle<'py>(
    py: Python<'py>,
    outline: Option<Bound<'py, PyAny>>,
    pieces: usize,
    size: [f64; 2],
    layout: String,
    tab: String,
    seed: u64,
) -> PyResult<Made<'py>> {
    let layout = match layout.as_str() {
        "grid" => Layout::Grid,
        "hexagons" => Layout::Hexagons,
        "voronoi" => Layout::Voronoi,
        _ => return Err(unknown("layout", layout, "\"grid\", \"hexagons\" or \"voronoi\"")),
    };
    let tab = match tab.as_str() {
        "none" => Tab::None,
        "knob" => Tab::Knob,
        "dovetail" => Tab::Dovetail,
        _ => return Err(unknown("tab", tab, "\"none\", \"knob\" or \"dovetail\"")),
    };
    let outline = outline.map(|points| crate::complexity::outline(&points)).transpose()?;
    let found = py.detach(|| {
        let puzzle = make(&PuzzleOptions { outline, size, pieces, layout, tab, seed })?;
        let report = report(&puzzle);
        let title = format!("Puzzle of {} pieces", puzzle.pieces());
        let drawings = [
            pieces_svg(&puzzle, 0.0),
            cuts_svg(&puzzle),
            pieces_dxf(&puzzle),
            cuts_dxf(&puzzle),
            page(&puzzle, &report, &title),
        ];
        Ok::<_, pompeiu::puzzle::PuzzleError>((puzzle, report, drawings))
    });
    let (puzzle, report, drawings) = found.map_err(Raise::raise)?;
    let outlines: PyResult<Vec<_>> =
        (0..puzzle.pieces()).map(|piece| array_of_rows(py, puzzle.outline(piece))).collect();
    Ok((outlines?, written(&report)?, drawings))
}
