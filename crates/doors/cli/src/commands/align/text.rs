//! The outcome for people.

use super::run::{Outcome, rows};
use crate::aligned::{percent, verdict};
use crate::exit::stopped_by;
use crate::numbers::{few, plain, point, rounded, time};
use crate::page::{Page, value};
use pompeiu::matching::align::FreeMotion;

/// A motion that is less than this share of the other kind is left out.
const NEGLIGIBLE: f64 = 1e-3;

pub(super) fn text(outcome: &Outcome) -> String {
    let found = &outcome.found;
    let mut page = Page::new();
    page.row("verdict", &verdict(found));
    page.gap();
    page.row("moving", &outcome.moving.described());
    page.row("fixed", &outcome.fixed.described());
    page.gap();
    page.row(
        "matched",
        &format!("{} of the moved surface, within {}", percent(found.matched), few(found.reach)),
    );
    page.row("", &format!("root mean square distance {} of what the fit rests on", few(found.rms)));
    page.row("turned by", &format!("{:.4}°", found.turn_degrees));
    if found.scale != 1.0 {
        page.row("scaled by", &plain(found.scale));
    }
    for (i, row) in rows(found).lines().enumerate() {
        page.row(if i == 0 { "matrix" } else { "" }, row);
    }
    for (i, other) in found.alternatives.iter().enumerate() {
        let line =
            format!("{} matched, turned {:.1}° from the best", percent(other.matched), other.apart_degrees);
        page.row(if i == 0 { "or else" } else { "" }, &line);
    }
    for (i, motion) in found.free_motions.iter().enumerate() {
        page.row(if i == 0 { "free" } else { "" }, &free(motion));
    }
    if found.stop.is_early() {
        page.row("", &format!("stopped by {}", stopped_by(found.stop)));
    }
    page.gap();
    let (there, back) = (&outcome.distance.a_to_b, &outcome.distance.b_to_a);
    page.row(
        "distance",
        &format!("{}   how far the moved mesh is from the fixed one: proven", value(there.distance)),
    );
    page.row("", &format!("{}   how far the fixed mesh is from the moved one: proven", value(back.distance)));
    page.row(
        "time",
        &format!(
            "read {}, align {}, distance {}, total {}",
            time(outcome.read),
            time(outcome.aligned),
            time(outcome.measured),
            time(outcome.total)
        ),
    );
    page.into_text()
}

/// The motion in words.
fn free(motion: &FreeMotion) -> String {
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [turn, shift] = [motion.turn, motion.shift].map(length);
    let direction = |v: [f64; 3]| point(v.map(|x| rounded(x / length(v)) + 0.0));
    let slide = || format!("slides along {}", direction(motion.shift));
    if turn <= NEGLIGIBLE {
        return slide();
    }
    let turns =
        format!("turns about {} through {}", direction(motion.turn), point(motion.point.map(rounded)));
    if shift <= NEGLIGIBLE * turn { turns } else { format!("{turns} as it {}", slide()) }
}
