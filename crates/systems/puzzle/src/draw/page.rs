//! An interactive page: pieces can be dragged, and the motion that takes a puzzle apart is played.

use super::{COLORS, Print};
use crate::{Motion, Puzzle, PuzzleReport};
use pompeiu_planar::svg::path_data;
use std::fmt::Write;

/// An interactive page: pieces can be dragged, pieces that hold each other move together, and pieces snap into place. It plays the
/// motion if there is one, and shows the picture on the pieces.
pub fn page(
    puzzle: &Puzzle,
    report: &PuzzleReport,
    motion: Option<&Motion>,
    print: Option<&Print>,
    title: &str,
) -> String {
    let mut drawing = print.map_or_else(String::new, |print| print.pattern(puzzle));
    for (cluster, pieces) in report.clusters.iter().enumerate() {
        let _ = writeln!(drawing, "<g class=\"cluster\">");
        for piece in pieces {
            let data = path_data(&puzzle.outline(*piece), true);
            let color = COLORS[if report.clusters.len() > 1 { cluster } else { *piece } % COLORS.len()];
            let fill = if print.is_some() { "url(#print)" } else { color };
            let lock = report.pieces[*piece].lock;
            let _ = writeln!(
                drawing,
                "<path data-piece=\"{piece}\" d=\"{data}\" fill=\"{fill}\"><title>piece {piece}: {lock}</title></path>"
            );
        }
        drawing.push_str("</g>\n");
    }
    let [width, height] = puzzle.size();
    let escaped = title.replace('&', "&amp;").replace('<', "&lt;");
    include_str!("page.html")
        .replace("{title}", &escaped)
        .replace("{verdict}", &verdict(puzzle, report))
        .replace("{view}", &format!("{} {} {} {}", -0.5 * width, -0.5 * height, 2.0 * width, 2.0 * height))
        .replace("{width}", &width.to_string())
        .replace("{height}", &height.to_string())
        .replace("{stroke}", &(0.002 * width.max(height)).to_string())
        .replace("{motion}", &motion.map_or_else(|| "null".to_owned(), frames))
        .replace("{drawing}", &drawing)
}

fn verdict(puzzle: &Puzzle, report: &PuzzleReport) -> String {
    let mut text = if report.locked {
        let depth = report.depth.unwrap_or(0.0);
        format!(
            "Locked: no piece can be moved in the plane against another one, even when all move at once. Depth {depth} of a piece's side."
        )
    } else if report.clusters.len() == puzzle.pieces() {
        "Free: no two pieces hold each other.".to_owned()
    } else {
        format!("Not locked: {} clusters. Pieces of one colour hold each other.", report.clusters.len())
    };
    if let Some(kerf) = &report.kerf {
        let holds = if kerf.holds { "holds" } else { "is not shown to hold" };
        let _ = write!(text, " With a cut {} wide it {holds}.", kerf.width);
    }
    text
}

/// The moving pieces as data for the page: index, initial centroid, and translation and rotation in degrees for each frame.
fn frames(motion: &Motion) -> String {
    let mut text = String::from("[");
    for piece in motion.moving() {
        let [x, y] = motion.centres[piece];
        let _ = write!(
            text,
            "{}{{\"piece\":{piece},\"x\":{x},\"y\":{y},\"frames\":[",
            if text.len() > 1 { "," } else { "" }
        );
        for (i, frame) in motion.frames.iter().enumerate() {
            let [dx, dy, turn] = frame[piece];
            let _ =
                write!(text, "{}[{dx:.5},{dy:.5},{:.4}]", if i > 0 { "," } else { "" }, turn.to_degrees());
        }
        text.push_str("]}");
    }
    text + "]"
}
