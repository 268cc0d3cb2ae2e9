//! Puzzles as drawings, as pictures, and as an interactive page.

mod canvas;
mod motion;
mod page;
mod print;

pub use motion::{motion_png, motion_svg};
pub use page::page;
pub use print::Print;

use crate::Puzzle;
use crate::order::cutting_order;
use canvas::Canvas;
use pompeiu_planar::svg::{Polyline, path_data};
use pompeiu_planar::{Outline, Point, dxf, offset, segments_meet};
use std::fmt::Write;

/// Colours of clusters.
const COLORS: [&str; 8] =
    ["#5b8cc9", "#dd8a4b", "#67a86d", "#c3636b", "#9482bd", "#a3846f", "#cf8ab8", "#4fa9b1"];

/// The header of a drawing of the puzzle, with y pointing down, with room for exploded pieces.
fn head(puzzle: &Puzzle, pull: f64) -> String {
    let [width, height] = puzzle.size();
    let margin = 0.03 * width.max(height);
    let [x, y] = [0.5 * width * pull + margin, 0.5 * height * pull + margin];
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"{} {} {w} {h}\" fill=\"none\" \
         stroke=\"#000\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n",
        -x,
        -y,
        0.001 * width.max(height),
        w = width + 2.0 * x,
        h = height + 2.0 * y,
    )
}

/// Options for drawing pieces.
#[derive(Clone, Copy, Debug, Default)]
pub struct PieceDrawing<'p> {
    /// Exploded view: additional displacement of each piece from the centre, relative to its distance from there; 0 leaves pieces
    /// in place.
    pub pull: f64,
    /// The width of the cut. If positive, each path is offset outwards by half of it, so that pieces have their nominal size after
    /// cutting, and pieces are spread at least so far that no two paths meet.
    pub kerf: f64,
    /// A picture printed on the pieces, for SVG.
    pub print: Option<&'p Print>,
}

/// Pieces as drawn: their paths, in place, and their displacements.
struct Laid {
    paths: Vec<Vec<Point>>,
    pull: f64,
}

/// Displacements tried grow by this factor, and start with it.
const FIRST_PULL: f64 = 0.1;
const NEXT_PULL: f64 = 1.2;
const MOST_PULL: f64 = 8.0;

impl Laid {
    fn new(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> Self {
        let outlines = (0..puzzle.pieces()).map(|piece| puzzle.outline(piece));
        if drawing.kerf <= 0.0 {
            return Self { paths: outlines.collect(), pull: drawing.pull };
        }
        let grown = |points: Vec<Point>| {
            let outline = Outline::new(points.clone()).ok();
            let found = outline.map(|outline| offset(&outline, 0.5 * drawing.kerf)).unwrap_or_default();
            let largest = found.into_iter().max_by(|a, b| a.area().total_cmp(&b.area()));
            largest.map_or(points, Outline::into_points)
        };
        let mut laid = Self { paths: outlines.map(grown).collect(), pull: drawing.pull.max(FIRST_PULL) };
        while laid.pull < MOST_PULL && laid.meet(puzzle) {
            laid.pull *= NEXT_PULL;
        }
        laid
    }

    fn shift(&self, puzzle: &Puzzle, piece: usize) -> Point {
        let points = &self.paths[piece];
        let n = points.len() as f64;
        let size = puzzle.size();
        [0, 1].map(|k| self.pull * (points.iter().map(|p| p[k]).sum::<f64>() / n - 0.5 * size[k]))
    }

    /// Whether two paths meet.
    fn meet(&self, puzzle: &Puzzle) -> bool {
        let moved: Vec<Vec<Point>> = (0..self.paths.len())
            .map(|piece| {
                let [x, y] = self.shift(puzzle, piece);
                self.paths[piece].iter().map(|p| [p[0] + x, p[1] + y]).collect()
            })
            .collect();
        let sides = |path: &[Point], i: usize| [path[i], path[(i + 1) % path.len()]];
        let is_apart = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
            (0..2).any(|k| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]))
        };
        let bounds: Vec<[Point; 2]> = moved
            .iter()
            .map(|path| {
                path.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
                    [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]
                })
            })
            .collect();
        (0..moved.len()).any(|a| {
            (0..a).any(|b| {
                !is_apart(bounds[a], bounds[b])
                    && (0..moved[a].len()).any(|i| {
                        let side = sides(&moved[a], i);
                        !is_apart(side, bounds[b])
                            && (0..moved[b].len()).any(|k| {
                                let other = sides(&moved[b], k);
                                !is_apart(side, other) && segments_meet(side, other)
                            })
                    })
            })
        })
    }
}

/// A drawing with one closed path for each piece.
///
/// # Shapes and units
/// Millimetres if that is the unit of the outline; y downwards. For pieces in place, common borders have the same digits in both
/// paths.
pub fn pieces_svg(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> String {
    let laid = Laid::new(puzzle, drawing);
    let mut text = head(puzzle, laid.pull);
    let mut fill = "";
    if let Some(print) = drawing.print {
        text.push_str(&print.pattern(puzzle));
        fill = " fill=\"url(#print)\"";
    }
    for (piece, points) in laid.paths.iter().enumerate() {
        let data = path_data(points, true);
        if laid.pull > 0.0 {
            let [x, y] = laid.shift(puzzle, piece);
            let _ = writeln!(
                text,
                "<path id=\"piece-{piece}\"{fill} transform=\"translate({x} {y})\" d=\"{data}\"/>"
            );
        } else {
            let _ = writeln!(text, "<path id=\"piece-{piece}\"{fill} d=\"{data}\"/>");
        }
    }
    text + "</svg>\n"
}

/// The pieces as closed polylines in DXF.
pub fn pieces_dxf(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> String {
    let laid = Laid::new(puzzle, drawing);
    let piece = |i: usize| {
        let [x, y] = laid.shift(puzzle, i);
        let points = laid.paths[i].iter().map(|p| if laid.pull > 0.0 { [p[0] + x, p[1] + y] } else { *p });
        Polyline { id: format!("piece_{i}"), points: points.collect(), is_closed: true }
    };
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
    let mut text = head(puzzle, 0.0);
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
