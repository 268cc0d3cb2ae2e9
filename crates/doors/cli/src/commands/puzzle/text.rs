//! The outcome for people.

use super::run::Outcome;
use crate::numbers::{few, grouped, time};
use crate::page::Page;
use pompeiu::puzzle::Proof;

/// The verdict first, then a row for each quantity.
pub(super) fn text(outcome: &Outcome) -> String {
    let report = &outcome.report;
    let number = |n: usize| grouped(n as u64);
    let mut page = Page::new();
    let verdict = match report.proof {
        Proof::Merging => {
            "locked: no motion of any pieces against each other is possible, decided in integers"
        }
        Proof::Multipliers => {
            "locked: no motion of any pieces against each other is possible, in double precision"
        }
        Proof::OneMoves => "not locked: pieces can move while all others stay, decided in integers",
        Proof::SeveralMove => "not locked: several pieces can move at once, in double precision",
        Proof::Undecided => {
            "undecided: no cluster can move alone, and there are too many to test all motions"
        }
    };
    page.row("result", verdict);
    if let Some(depth) = report.depth {
        let unit = outcome.puzzle.unit();
        page.row(
            "depth",
            &format!("{}: holds without detail of up to {depth} of a piece's side", few(depth * unit)),
        );
    }
    let free: Vec<usize> =
        report.pieces.iter().filter(|piece| piece.lock == "free").map(|piece| piece.id).collect();
    if !free.is_empty() {
        const SHOWN: usize = 12;
        let names = free.iter().take(SHOWN).map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let more = if free.len() > SHOWN { ", …" } else { "" };
        page.row("free", &format!("{} pieces: {names}{more}", number(free.len())));
    }
    page.row(
        "pieces",
        &format!("{} in {} clusters", number(report.pieces.len()), number(report.clusters.len())),
    );
    let exact = if report.area.is_exact { "equal in integers" } else { "not equal" };
    page.row(
        "areas",
        &format!("sum {}, outline {}: {exact}", few(report.area.sum), few(report.area.outline)),
    );
    if report.straight_borders > 0 {
        page.row(
            "straight",
            &format!("{} borders between pieces have no tab", number(report.straight_borders)),
        );
    }
    page.row("time", &format!("lock {}, total {}", time(report.timing.lock), time(outcome.total)));
    page.into_text()
}
