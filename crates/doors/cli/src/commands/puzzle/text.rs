//! The outcome for people.

use super::args::Files;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{counted, few, grouped, time};
use crate::page::Page;
use pompeiu::puzzle::{Proof, PuzzleReport};

/// The verdict first, then a row for each quantity.
pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let mut page = Page::new();
    let verdict = match report.proof {
        Proof::Merging => {
            "locked: no motion of any pieces against each other is possible, decided in integers"
        }
        Proof::Multipliers => {
            "locked: no motion of any pieces against each other is possible, by multipliers checked in integers"
        }
        Proof::OneMoves => "not locked: pieces can move while all others stay, decided in integers",
        Proof::SeveralMove => "not locked: several pieces can move at once, in double precision",
        Proof::Undecided if report.stop.is_early() => "undecided: the test for motions was ended early",
        Proof::Undecided => {
            "undecided: no cluster can move alone, and rounding does not let tell whether several can"
        }
    };
    page.row("result", verdict);
    if let Some(depth) = report.depth {
        let unit = report.unit();
        page.row(
            "depth",
            &format!("{}: holds without detail of up to {depth} of a piece's side", few(depth * unit)),
        );
    }
    if let Some(kerf) = &report.kerf {
        let width = few(kerf.width);
        let verdict = match kerf.widest {
            Some(widest) if widest > kerf.width => {
                format!(
                    "{width}: no two pieces can part with that gap between them, nor with one of {}",
                    few(widest)
                )
            }
            Some(_) => format!("{width}: no two pieces can part with that gap between them"),
            None => format!(
                "{width}: not shown to hold with that gap; {} that hold",
                counted(kerf.clusters.len(), "part")
            ),
        };
        page.row("cut", &verdict);
        if !kerf.split.is_empty() {
            let pieces = counted(kerf.split.len(), "piece");
            page.row("", &format!("{pieces} cut in parts, or away: {}", names(&kerf.split)));
        }
    }
    if let Some(packing) = &report.packing {
        let [width, height] = packing.sheet.map(few);
        let (used, filled) = (100.0 * packing.used, 100.0 * packing.filled);
        let text = format!("{width} × {height}: pieces cover {used:.0} %, {filled:.0} % up to the last one");
        page.row("sheet", &text);
    }
    let free: Vec<usize> =
        report.pieces.iter().filter(|piece| piece.lock == "free").map(|piece| piece.id).collect();
    if !free.is_empty() {
        page.row("free", &format!("{}: {}", counted(free.len(), "piece"), names(&free)));
    }
    page.row(
        "pieces",
        &format!("{} in {}", grouped(report.pieces.len() as u64), counted(report.clusters.len(), "cluster")),
    );
    if !report.whimsies.is_empty() {
        page.row("whimsies", &format!("pieces {}", names(&report.whimsies)));
    }
    likeness(&mut page, report);
    let exact = if report.area.is_exact { "equal in integers" } else { "not equal" };
    page.row(
        "areas",
        &format!("sum {}, outline {}: {exact}", few(report.area.sum), few(report.area.outline)),
    );
    necks(&mut page, report);
    if !report.without_tab.is_empty() {
        let text = format!("{} between pieces without a tab", counted(report.without_tab.len(), "border"));
        // Where no tabs were asked for, it is all of them.
        let names = report.least_neck.map_or_else(String::new, |_| {
            let pairs = report.without_tab.iter().map(|[a, b]| format!("{a}–{b}"));
            format!(": {}", listed(pairs))
        });
        page.row("straight", &(text + &names));
    }
    if let Some(motion) = &report.motion {
        let end = if motion.is_apart { "until they are apart" } else { "as far as it was followed" };
        page.row("motion", &format!("of {}, {end}", counted(motion.moving.len(), "piece")));
    }
    if report.stop.is_early() {
        page.row("stopped", &format!("early by {}: the best puzzle found by then", stopped_by(report.stop)));
    }
    page.row("time", &format!("lock {}, total {}", time(report.timing.lock), time(answer.timing.total)));
    page.into_text()
}

/// The narrowest neck, beside what tabs leave at least.
fn necks(page: &mut Page, report: &PuzzleReport) {
    let Some((piece, neck)) = report.narrowest() else { return };
    let text = format!("at least {}, at piece {piece}", few(neck.width));
    let text = match report.least_neck {
        Some(least) if neck.width < least => {
            format!(
                "{text}: below the {} that tabs leave, because of the outline or the shape of pieces, or because no wider one holds them",
                few(least)
            )
        }
        _ => text,
    };
    page.row("necks", &text);
}

/// The first numbers of a list.
fn names(list: &[usize]) -> String {
    listed(list.iter().map(ToString::to_string))
}

/// The first of some names.
fn listed(names: impl ExactSizeIterator<Item = String>) -> String {
    const SHOWN: usize = 12;
    let is_cut = names.len() > SHOWN;
    names.take(SHOWN).collect::<Vec<_>>().join(", ") + if is_cut { ", …" } else { "" }
}

/// How similar pieces are to the shape: all, those inside, those at the outline.
fn likeness(page: &mut Page, report: &PuzzleReport) {
    let of = |which: &dyn Fn(bool) -> bool| -> Option<[f64; 2]> {
        let pieces = report.pieces.iter().filter(|piece| which(piece.is_at_outline));
        let found: Vec<_> = pieces.filter_map(|piece| piece.similarity).collect();
        let n = found.len() as f64;
        let sums = found.iter().fold([0.0; 2], |s, f| [s[0] + f.iou, s[1] + f.hausdorff / report.unit()]);
        (n > 0.0).then(|| sums.map(|sum| sum / n))
    };
    let Some([iou, hausdorff]) = of(&|_| true) else { return };
    let part = |name: &str, which: &dyn Fn(bool) -> bool| {
        of(which).map_or_else(String::new, |[iou, _]| format!(", {name} {iou:.3}"))
    };
    let inside = part("inside", &|is_at_outline| !is_at_outline);
    let outer = part("at the outline", &|is_at_outline| is_at_outline);
    page.row("likeness", &format!("mean overlap {iou:.3}{inside}{outer}"));
    page.row("", &format!("mean Hausdorff distance {hausdorff:.2} of a piece's side"));
}
