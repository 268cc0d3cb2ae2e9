//! Puzzles as drawings, and as a page to play with.

use crate::{Puzzle, PuzzleReport};
use pompeiu_planar::svg::{Polyline, path_data};
use pompeiu_planar::{Point, dxf};
use std::fmt::Write;

/// Colours of clusters.
const COLORS: [&str; 8] =
    ["#5b8cc9", "#dd8a4b", "#67a86d", "#c3636b", "#9482bd", "#a3846f", "#cf8ab8", "#4fa9b1"];

/// The head of a drawing that holds the puzzle, with y upwards turned down, and pieces pulled apart by a factor of the distance from the middle.
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

/// Where a piece is shifted to when pieces are pulled apart.
fn shift(puzzle: &Puzzle, points: &[Point], pull: f64) -> Point {
    let n = points.len() as f64;
    let size = puzzle.size();
    [0, 1].map(|k| pull * (points.iter().map(|p| p[k]).sum::<f64>() / n - 0.5 * size[k]))
}

/// A drawing with one closed path for each piece, `pull` times as far from the middle as they belong in addition; 0 leaves them in place.
///
/// # Shapes and units
/// Millimetres, if that is the unit of the outline; y downwards. In place, what two pieces share has the same digits in both.
pub fn pieces_svg(puzzle: &Puzzle, pull: f64) -> String {
    let mut text = head(puzzle, pull);
    for piece in 0..puzzle.pieces() {
        let points = puzzle.outline(piece);
        let data = path_data(&points, true);
        if pull > 0.0 {
            let [x, y] = shift(puzzle, &points, pull);
            let _ =
                writeln!(text, "<path id=\"piece-{piece}\" transform=\"translate({x} {y})\" d=\"{data}\"/>");
        } else {
            let _ = writeln!(text, "<path id=\"piece-{piece}\" d=\"{data}\"/>");
        }
    }
    text + "</svg>\n"
}

/// A drawing with each border once, to be cut in its order: borders between pieces first, the outline last, so that pieces stay in place;
/// among each of both the nearest one comes next.
pub fn cuts_svg(puzzle: &Puzzle) -> String {
    let mut text = head(puzzle, 0.0);
    for Polyline { id, points, .. } in cuts(puzzle) {
        let _ = writeln!(text, "<path id=\"{id}\" d=\"{}\"/>", path_data(&points, false));
    }
    text + "</svg>\n"
}

/// The pieces as closed polylines, for programs that read DXF.
pub fn pieces_dxf(puzzle: &Puzzle) -> String {
    let piece = |i| Polyline { id: format!("piece_{i}"), points: puzzle.outline(i), is_closed: true };
    dxf::write(&(0..puzzle.pieces()).map(piece).collect::<Vec<_>>(), true)
}

/// Each border once, in the order of [`cuts_svg`], for programs that read DXF.
pub fn cuts_dxf(puzzle: &Puzzle) -> String {
    dxf::write(&cuts(puzzle), true)
}

/// The borders in the order in which they are cut, each from the end that is nearer.
fn cuts(puzzle: &Puzzle) -> Vec<Polyline> {
    let mut found = Vec::new();
    let mut at = [0.0, 0.0];
    for inside in [true, false] {
        let mut left: Vec<usize> =
            (0..puzzle.borders().len()).filter(|i| puzzle.borders()[*i].right.is_some() == inside).collect();
        while !left.is_empty() {
            let distance = |p: Point| libm::hypot(p[0] - at[0], p[1] - at[1]);
            let ends = |i: usize| {
                let corners = &puzzle.borders()[i].corners;
                [corners[0], corners[corners.len() - 1]].map(|corner| distance(puzzle.point(corner)))
            };
            let near = |k: &usize| ends(left[*k]).into_iter().fold(f64::INFINITY, f64::min);
            let next = (0..left.len()).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
            let border = left.swap_remove(next);
            let [first, last] = ends(border);
            let mut points = puzzle.border_points(border);
            if last < first {
                points.reverse();
            }
            at = points[points.len() - 1];
            let kind = if inside { "cut" } else { "outline" };
            found.push(Polyline { id: format!("{kind}-{border}"), points, is_closed: false });
        }
    }
    found
}

/// A page on which pieces can be dragged: pieces that hold each other move together, and snap where they belong.
pub fn page(puzzle: &Puzzle, report: &PuzzleReport, title: &str) -> String {
    let mut drawing = String::new();
    for (cluster, pieces) in report.clusters.iter().enumerate() {
        let _ = writeln!(drawing, "<g class=\"cluster\">");
        for piece in pieces {
            let data = path_data(&puzzle.outline(*piece), true);
            let color = COLORS[if report.clusters.len() > 1 { cluster } else { *piece } % COLORS.len()];
            let lock = report.pieces[*piece].lock;
            let _ = writeln!(
                drawing,
                "<path d=\"{data}\" fill=\"{color}\"><title>piece {piece}: {lock}</title></path>"
            );
        }
        drawing.push_str("</g>\n");
    }
    let [width, height] = puzzle.size();
    let verdict = if report.locked {
        let depth = report.depth.unwrap_or(0.0);
        format!(
            "Locked: no piece can be moved in the plane against another one, even when all move at once. Depth {depth} of a piece's side."
        )
    } else if report.clusters.len() == puzzle.pieces() {
        "Free: no two pieces hold each other.".to_owned()
    } else {
        format!("Not locked: {} clusters. Pieces of one colour hold each other.", report.clusters.len())
    };
    let escaped = title.replace('&', "&amp;").replace('<', "&lt;");
    include_str!("page.html")
        .replace("{title}", &escaped)
        .replace("{verdict}", &verdict)
        .replace("{view}", &format!("{} {} {} {}", -0.5 * width, -0.5 * height, 2.0 * width, 2.0 * height))
        .replace("{width}", &width.to_string())
        .replace("{height}", &height.to_string())
        .replace("{stroke}", &(0.002 * width.max(height)).to_string())
        .replace("{drawing}", &drawing)
}
