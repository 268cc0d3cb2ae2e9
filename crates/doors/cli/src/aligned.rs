//! How sure an alignment is.

use crate::numbers::few;
use crate::printer::Printer;
use pompeiu::matching::align::Registration;
use std::path::Path;

/// Warns of an alignment that is not to be trusted.
pub(crate) fn warn([a, b]: [&Path; 2], found: &Registration, printer: &Printer) {
    if !found.fits {
        printer.warning(format_args!(
            "no place of {} on {} fits: they seem to be different shapes, and the alignment is not to be trusted",
            b.display(),
            a.display()
        ));
    }
}

/// Verdicts, which the guide explains.
const UNIQUE: &str = "ALIGNED: no other place that was tried fits as well";
const NOTHING: &str = "DIFFERENT SHAPES: nothing fits";

/// The verdict where other places fit nearly as well.
fn symmetric(others: usize) -> String {
    let fit =
        if others == 1 { "1 other place fits".to_owned() } else { format!("{others} other places fit") };
    format!("ALIGNED, but {fit} nearly as well: the shape may be symmetric")
}

/// The verdict where motions leave the fit as it is.
fn free(motions: usize) -> String {
    let leave = if motions == 1 { "a motion leaves".to_owned() } else { format!("{motions} motions leave") };
    format!("ALIGNED, but {leave} the fit as it is")
}

/// The sentence about an alignment that a person acts on.
pub(crate) fn verdict(found: &Registration) -> String {
    if !found.fits {
        return format!(
            "{NOTHING}; at the best place {} of the moved surface lies within {} of the fixed one",
            percent(found.matched),
            few(found.reach)
        );
    }
    let place = match (found.alternatives.len(), found.free_motions.len()) {
        (0, 0) => UNIQUE.to_owned(),
        (others, 0) => symmetric(others),
        (_, motions) => free(motions),
    };
    format!("{place}; {} matched", percent(found.matched))
}

pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_guide_explains_the_verdicts_that_are_given() {
        let guide = include_str!("../../../../docs/guide/pages/align.md");
        let (others, _) =
            symmetric(2).split_once(": ").map(|(verdict, why)| (verdict.to_owned(), why.to_owned())).unwrap();
        for verdict in [UNIQUE, NOTHING, &others, &free(1)] {
            assert!(guide.contains(&format!("`{verdict}`")), "{verdict}");
        }
    }
}
