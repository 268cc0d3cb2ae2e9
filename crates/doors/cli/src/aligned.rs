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

/// The sentence about an alignment that a person acts on.
pub(crate) fn verdict(found: &Registration) -> String {
    if !found.fits {
        return format!(
            "DIFFERENT SHAPES: nothing fits; at the best place {} of the moved surface lies within {} of the fixed one",
            percent(found.matched),
            few(found.reach)
        );
    }
    let place = match (found.alternatives.len(), found.free_motions.len()) {
        (0, 0) => "ALIGNED: no other place that was tried fits as well".to_owned(),
        (others, 0) => format!(
            "ALIGNED, but {} nearly as well: the shape may be symmetric",
            if others == 1 { "1 other place fits".to_owned() } else { format!("{others} other places fit") }
        ),
        (_, free) => format!(
            "ALIGNED, but {} the fit as it is",
            if free == 1 { "a motion leaves".to_owned() } else { format!("{free} motions leave") }
        ),
    };
    format!("{place}; {} matched", percent(found.matched))
}

pub(crate) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
