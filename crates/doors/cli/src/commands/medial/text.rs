//! The outcome for people.

use super::run::Outcome;
use crate::exit::stopped_by;
use crate::numbers::{grouped, time};
use crate::page::Page;

/// A row for each quantity.
pub(super) fn text(outcome: &Outcome) -> String {
    let medial = &outcome.medial;
    let number = |n: usize| grouped(n as u64);
    let mut page = Page::new();
    let (balls, shrunk) = (number(medial.balls.len()), number(medial.shrunk));
    page.row(
        "result",
        &format!("{balls} balls in the place of {shrunk}, joined by {} edges", number(medial.edges.len())),
    );
    if medial.stop.is_early() {
        page.row("", &format!("stopped early by {}", stopped_by(medial.stop)));
    }
    let [lower, upper] = medial.deviation.surface_to_balls;
    page.row("distance", &format!("from the surface to the balls between {lower:.6} and {upper:.6}"));
    page.row("", &format!("out of the surface at most {:.6}", medial.deviation.balls_to_surface));
    page.row("overlaps", &format!("{} pairs of balls", number(medial.overlaps().len())));
    page.row("time", &time(outcome.total));
    page.into_text()
}
