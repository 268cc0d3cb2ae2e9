//! Puzzles as drawings, as pictures, and as an interactive page.

mod canvas;
mod laid;
mod motion;
mod options;
mod page;
mod print;

pub use motion::{motion_png, motion_svg};
pub use options::PieceDrawing;
pub use page::page;
pub use print::Print;

use crate::order::cutting_order;
use crate::{Place, Puzzle};
use canvas::Canvas;
use laid::Laid;
use pompeiu_planar::svg::{Polyline, path_data};
use pompeiu_planar::{Outline, Point, dxf, offset};
use std::fmt::Write;

/// Colours of clusters.
const COLORS: [&str; 8] =
    ["#5b8cc9", "#dd8a4b", "#67a86d", "#c3636b", "#9482bd", "#a3846f", "#cf8ab8", "#4fa9b1"];

/// The header of a drawing of the puzzle, with y pointing down, that shows an area: its corner and its size.
fn head(puzzle: &Puzzle, [[x, y], [w, h]]: [Point; 2]) -> String {
    let [width, height] = puzzle.size();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"{x} {y} {w} {h}\" fill=\"none\" \
         stroke=\"#000\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n",
        0.001 * width.max(height),
    )
}

/// A drawing with one closed path for each piece.
///
/// # Shapes and units
/// Millimetres if that is the unit of the outline; y downwards. For pieces in place, common borders have the same digits in both
/// paths.
pub fn pieces_svg(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> String {
    let laid = Laid::new(puzzle, drawing);
    let mut text = head(puzzle, laid.area);
    let mut fill = "";
    if let Some(print) = drawing.print {
        text.push_str(&print.pattern(puzzle));
        fill = " fill=\"url(#print)\"";
    }
    for (piece, place) in laid.places.iter().enumerate() {
        // A picture moves with its piece.
        let (transform, points) = match drawing.print {
            Some(_) if *place != Place::default() => {
                (format!(" transform=\"{}\"", transform(place)), laid.paths[piece].clone())
            }
            _ => (String::new(), laid.path(piece)),
        };
        let data = path_data(&points, true);
        let _ = writeln!(text, "<path id=\"piece-{piece}\"{fill}{transform} d=\"{data}\"/>");
    }
    text + "</svg>\n"
}

/// A place as an attribute.
fn transform(place: &Place) -> String {
    let [x, y] = place.shift;
    if place.turn == 0.0 {
        return format!("translate({x} {y})");
    }
    format!("translate({x} {y}) rotate({})", place.turn)
}

/// The pieces as closed polylines in DXF.
pub fn pieces_dxf(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> String {
    let laid = Laid::new(puzzle, drawing);
    let piece = |i: usize| Polyline { id: format!("piece_{i}"), points: laid.path(i), is_closed: true };
    dxf::write(&(0..puzzle.pieces()).map(piece).collect::<Vec<_>>(), true)
}

/// The pieces in place as a PNG picture: with a printed picture at its resolution, or coloured by cluster.
///
/// # Errors
/// The encoder's message.
pub fn pieces_png(puzzle: &Puzzle, print: Option<&Print>) -> Result<Vec<u8>, String> {
    let mut canvas =
        Canvas::new(puzzle, [[0.0; 2], puzzle.size()], print.map_or(PNG_SIDE, |p| p.pixels(puzzle)));
    for piece in 0..puzzle.pieces() {
        let points = puzzle.outline(piece);
        match print {
            Some(print) => canvas.fill(&points, |p| print.at(puzzle, p)),
            None => canvas.fill(&points, |_| rgb(COLORS[piece % COLORS.len()])),
        }
    }
    for border in 0..puzzle.borders().len() {
        canvas.stroke(&puzzle.border_points(border), LINE, [28, 37, 48]);
    }
    canvas.png()
}

/// Pixels along the longer side of a picture, and the width of its lines in pixels.
const PNG_SIDE: f64 = 1600.0;
const LINE: f64 = 1.5;

/// A colour from six hexadecimal digits.
fn rgb(text: &str) -> [u8; 3] {
    let digits = u32::from_str_radix(text.trim_start_matches('#'), 16).unwrap_or(0);
    [16, 8, 0].map(|shift| (digits >> shift) as u8)
}

/// A drawing with each border once, in cutting order: borders between pieces first, the outline last, and no border of a piece that
/// is already loose. Among the borders that may be cut, the nearest comes next.
///
/// For a positive kerf, the outline is one path offset outwards by half of it, so that the puzzle has its nominal size. Borders
/// between pieces are cut once, which leaves a gap as wide as the kerf: see [`crate::kerf`].
pub fn cuts_svg(puzzle: &Puzzle, kerf: f64) -> String {
    let mut text = head(puzzle, laid::around(puzzle, 0.0));
    for Polyline { id, points, is_closed } in cuts(puzzle, kerf) {
        let _ = writeln!(text, "<path id=\"{id}\" d=\"{}\"/>", path_data(&points, is_closed));
    }
    text + "</svg>\n"
}

/// The same in DXF.
pub fn cuts_dxf(puzzle: &Puzzle, kerf: f64) -> String {
    dxf::write(&cuts(puzzle, kerf), true)
}

/// The borders in cutting order, each starting at its nearer end.
fn cuts(puzzle: &Puzzle, kerf: f64) -> Vec<Polyline> {
    let around = (kerf > 0.0).then(|| Outline::new(puzzle.outer()).ok()).flatten();
    let grown = around.map(|outline| offset(&outline, 0.5 * kerf)).unwrap_or_default();
    let largest = grown.into_iter().max_by(|a, b| a.area().total_cmp(&b.area()));
    let is_outline = |border: usize| puzzle.borders()[border].right.is_none();
    let mut found: Vec<Polyline> = cutting_order(puzzle)
        .into_iter()
        .filter(|(border, _)| largest.is_none() || !is_outline(*border))
        .map(|(border, is_reversed)| {
            let mut points = puzzle.border_points(border);
            if is_reversed {
                points.reverse();
            }
            let kind = if is_outline(border) { "outline" } else { "cut" };
            Polyline { id: format!("{kind}-{border}"), points, is_closed: false }
        })
        .collect();
    let outline = largest.map(|outline| Polyline {
        id: "outline".to_owned(),
        points: outline.into_points(),
        is_closed: true,
    });
    found.extend(outline);
    found
}
