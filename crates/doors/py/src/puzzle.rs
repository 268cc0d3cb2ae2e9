//! Jigsaw puzzles.

use crate::arrays::array_of_rows;
use crate::errors::{Raise, unknown};
use crate::hausdorff::limits;
use crate::json::written;
use crate::wait::{self, Share, Watch};
use numpy::PyArray2;
use pompeiu::puzzle::{
    Answer, Layout, LikeOptions, Method, PieceName, PieceShape, PuzzleOptions, Tab, Variant, cuts_dxf,
    cuts_svg, make, make_like, page, pieces_dxf, pieces_svg, report, report_like,
};
use pyo3::prelude::*;

/// Outlines of pieces, the report, and the drawings: pieces and cuts as SVG, both as DXF, the page.
type Made<'py> = (Vec<Bound<'py, PyArray2<f64>>>, String, [String; 5]);

/// What pieces shall be like, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Likeness<'py> {
    name: String,
    points: Option<Bound<'py, PyAny>>,
    method: String,
    metric: String,
    corners: bool,
    feedback: bool,
    mirrors: bool,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

/// What `piece` may be.
const PIECES: &str =
    "\"square\", \"hexagon\", \"classic\", \"corner\", \"fish\", \"bird\", \"star\" or an array";

impl Likeness<'_> {
    fn options(self) -> PyResult<LikeOptions<'static>> {
        let shape = match self.points {
            Some(points) => PieceShape::Outline(crate::complexity::outline(&points)?),
            None => match PieceName::named(&self.name) {
                Some(name) => PieceShape::Built(name),
                None => return Err(unknown("piece", self.name, PIECES)),
            },
        };
        let answer = match self.metric.as_str() {
            "distance" => Answer::SignedDistance,
            "least" => Answer::Least,
            "greatest" => Answer::Greatest,
            _ => return Err(unknown("metric", self.metric, "\"distance\", \"least\" or \"greatest\"")),
        };
        let variant = if self.corners { Variant::Points } else { Variant::Edges };
        let method = match self.method.as_str() {
            "descent" => Method::Descent,
            "lloyd" => Method::Lloyd { answer, variant, feedback: self.feedback },
            _ => return Err(unknown("method", self.method, "\"descent\" or \"lloyd\"")),
        };
        let limits = limits(self.threads, self.time_limit, None)?;
        Ok(LikeOptions { shape, method, mirrors: self.mirrors, limits, progress: None })
    }
}

/// Makes a puzzle and tests it.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "they are those of the function in Python")]
pub(crate) fn puzzle<'py>(
    py: Python<'py>,
    outline: Option<Bound<'py, PyAny>>,
    pieces: usize,
    size: [f64; 2],
    layout: String,
    tab: String,
    seed: u64,
    piece: Option<Likeness<'py>>,
    progress: Option<&Bound<'_, PyAny>>,
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
    let like = piece.map(Likeness::options).transpose()?;
    let options = PuzzleOptions { outline, size, pieces, layout, tab, seed };
    let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
        let (puzzle, report) = match like {
            None => {
                let puzzle = make(&options)?;
                let report = report(&puzzle);
                (puzzle, report)
            }
            Some(like) => {
                let made = make_like(&options, &LikeOptions { progress: Some(&*watch), ..like })?;
                let report = report_like(&made);
                (made.puzzle, report)
            }
        };
        let title = format!("Puzzle of {} pieces", puzzle.pieces());
        let drawings = [
            pieces_svg(&puzzle, 0.0),
            cuts_svg(&puzzle),
            pieces_dxf(&puzzle),
            cuts_dxf(&puzzle),
            page(&puzzle, &report, &title),
        ];
        Ok::<_, pompeiu::puzzle::PuzzleError>((puzzle, report, drawings))
    })?;
    let (puzzle, report, drawings) = found.map_err(Raise::raise)?;
    let outlines: PyResult<Vec<_>> =
        (0..puzzle.pieces()).map(|piece| array_of_rows(py, puzzle.outline(piece))).collect();
    Ok((outlines?, written(&report)?, drawings))
}
