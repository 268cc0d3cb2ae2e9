//! Jigsaw puzzles.

use crate::arrays::array_of_rows;
use crate::errors::{Raise, unknown};
use crate::hausdorff::limits;
use crate::json::written;
use crate::wait::{self, Share, Watch};
use numpy::PyArray2;
use pompeiu::core::run::Control;
use pompeiu::puzzle::{
    Answer, Layout, LikeOptions, Method, PieceDrawing, PieceName, PieceShape, Print, PuzzleOptions, Tab,
    Variant, cuts_dxf, cuts_svg, kerf, make, make_like, motion_svg, page, pieces_dxf, pieces_png, pieces_svg,
    report, report_like, take_apart,
};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// Outlines of pieces, the report, and the drawings: pieces and cuts as SVG, both as DXF, the page, pieces as PNG, the motion; the last one is
/// empty where there is none.
type Made<'py> = (Vec<Bound<'py, PyArray2<f64>>>, String, Vec<Bound<'py, PyBytes>>);

/// What pieces shall be like, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
#[allow(clippy::struct_excessive_bools, reason = "each one is an argument of the function in Python")]
pub(crate) struct Likeness<'py> {
    name: String,
    points: Option<Bound<'py, PyAny>>,
    method: String,
    metric: String,
    corners: bool,
    feedback: bool,
    mirrors: bool,
    free_outline: bool,
    threads: Option<usize>,
    time_limit: Option<f64>,
    memory_limit: Option<usize>,
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
        let limits = limits(self.threads, self.time_limit, self.memory_limit)?;
        let (mirrors, free_outline) = (self.mirrors, self.free_outline);
        Ok(LikeOptions { shape, method, mirrors, free_outline, limits, progress: None })
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
    whimsies: Vec<Bound<'py, PyAny>>,
    cut: f64,
    image: Option<Vec<u8>>,
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
    let print = image.map(|bytes| Print::read(&bytes)).transpose();
    let print = print.map_err(Raise::raise)?;
    let whimsies =
        whimsies.into_iter().map(|points| crate::complexity::outline(&points)).collect::<PyResult<_>>()?;
    let options = PuzzleOptions { whimsies, outline, size, pieces, layout, tab, seed };
    let found = wait::run(py, progress, |watch: &mut Watch<'_, Share>| {
        let (puzzle, mut report) = match like {
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
        if cut > 0.0 {
            report.kerf = Some(kerf(&puzzle, cut, &Control::start(&pompeiu::core::run::Limits::default())));
        }
        let motion = take_apart(&puzzle, &report.found);
        let drawing = PieceDrawing { pull: 0.0, kerf: cut, print: print.as_ref() };
        let title = format!("Puzzle of {} pieces", puzzle.pieces());
        let drawings = [
            pieces_svg(&puzzle, &drawing).into_bytes(),
            cuts_svg(&puzzle, cut).into_bytes(),
            pieces_dxf(&puzzle, &drawing).into_bytes(),
            cuts_dxf(&puzzle, cut).into_bytes(),
            page(&puzzle, &report, motion.as_ref(), print.as_ref(), &title).into_bytes(),
            pieces_png(&puzzle, print.as_ref()).unwrap_or_default(),
            motion.map(|motion| motion_svg(&puzzle, &motion).into_bytes()).unwrap_or_default(),
        ];
        Ok::<_, pompeiu::puzzle::PuzzleError>((puzzle, report, drawings))
    })?;
    let (puzzle, report, drawings) = found.map_err(Raise::raise)?;
    let outlines: PyResult<Vec<_>> =
        (0..puzzle.pieces()).map(|piece| array_of_rows(py, puzzle.outline(piece))).collect();
    let drawings = drawings.iter().map(|drawing| PyBytes::new(py, drawing)).collect();
    Ok((outlines?, written(&report)?, drawings))
}
