//! Drawings of the motion that takes a puzzle apart.

use super::canvas::Canvas;
use super::{COLORS, LINE, PNG_SIDE, rgb};
use crate::{Motion, Puzzle};
use pompeiu_planar::Point;
use pompeiu_planar::svg::path_data;
use std::fmt::Write;

/// Duration of the motion in seconds.
const SECONDS: f64 = 4.0;

/// Colours of stationary pieces, and of the paths of centroids.
const STAYS: &str = "#e3e7ea";
const WAY: &str = "#1c2530";

/// The bounding box of the puzzle and of the whole motion.
fn bounds(puzzle: &Puzzle, motion: &Motion) -> [Point; 2] {
    let start = [[0.0; 2], puzzle.size()];
    let end = motion.frames.len() - 1;
    motion
        .moving()
        .flat_map(|piece| motion.outline(puzzle, piece, end))
        .fold(start, |[low, high], p| [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))])
}

/// A drawing with a repeating animation of the motion. Programs that do not play animations show its end, its start, and the paths
/// of the centroids.
pub fn motion_svg(puzzle: &Puzzle, motion: &Motion) -> String {
    let [low, high] = bounds(puzzle, motion);
    let longer = puzzle.size().into_iter().fold(0.0, f64::max);
    let margin = 0.03 * longer;
    let [w, h] = [0, 1].map(|k| high[k] - low[k] + 2.0 * margin);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"{} {} {w} {h}\" fill=\"none\" \
         stroke=\"{WAY}\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n",
        low[0] - margin,
        low[1] - margin,
        0.0015 * longer
    );
    let moving: Vec<usize> = motion.moving().collect();
    for piece in 0..puzzle.pieces() {
        let data = path_data(&puzzle.outline(piece), true);
        let kind = if moving.contains(&piece) {
            "fill=\"#fff\" stroke-dasharray=\"2 2\""
        } else {
            "fill=\"#e3e7ea\""
        };
        let _ = writeln!(text, "<path id=\"home-{piece}\" {kind} d=\"{data}\"/>");
    }
    let end = motion.frames.len() - 1;
    for piece in moving {
        let ([x, y], data) = (motion.centres[piece], path_data(&puzzle.outline(piece), true));
        let list = |of: &dyn Fn(&[f64; 3]) -> String| {
            motion.frames.iter().map(|frame| of(&frame[piece])).collect::<Vec<_>>().join(";")
        };
        let shifts = list(&|[dx, dy, _]| format!("{dx:.5} {dy:.5}"));
        let turns = list(&|[_, _, turn]| format!("{:.4} {x:.5} {y:.5}", turn.to_degrees()));
        let [dx, dy, turn] = motion.frames[end][piece];
        let animate = |kind: &str, values: &str| {
            format!(
                "<animateTransform attributeName=\"transform\" type=\"{kind}\" dur=\"{SECONDS}s\" repeatCount=\"indefinite\" values=\"{values}\"/>"
            )
        };
        let _ = writeln!(
            text,
            "<g transform=\"translate({dx} {dy})\">{}<g transform=\"rotate({} {x} {y})\">{}\
             <path id=\"piece-{piece}\" fill=\"{}\" fill-opacity=\"0.8\" d=\"{data}\"/></g></g>",
            animate("translate", &shifts),
            turn.to_degrees(),
            animate("rotate", &turns),
            COLORS[piece % COLORS.len()],
        );
        let _ = writeln!(text, "<path id=\"way-{piece}\" d=\"{}\"/>", path_data(&motion.way(piece), false));
    }
    text + "</svg>\n"
}

/// The end of the motion as a PNG picture, with the initial positions of pieces and the paths of their centroids.
///
/// # Errors
/// The encoder's message.
pub fn motion_png(puzzle: &Puzzle, motion: &Motion) -> Result<Vec<u8>, String> {
    let mut canvas = Canvas::new(puzzle, bounds(puzzle, motion), PNG_SIDE);
    let moving: Vec<usize> = motion.moving().collect();
    for piece in (0..puzzle.pieces()).filter(|piece| !moving.contains(piece)) {
        canvas.fill(&puzzle.outline(piece), |_| rgb(STAYS));
    }
    for border in 0..puzzle.borders().len() {
        canvas.stroke(&puzzle.border_points(border), LINE, rgb("#8895a3"));
    }
    for piece in moving {
        let mut points = motion.outline(puzzle, piece, motion.frames.len() - 1);
        canvas.fill(&points, |_| rgb(COLORS[piece % COLORS.len()]));
        points.push(points[0]);
        canvas.stroke(&points, LINE, rgb(WAY));
        canvas.stroke(&motion.way(piece), LINE, rgb(WAY));
    }
    canvas.png()
}
