//! Aligning one mesh with the other before they are compared, and how sure an alignment is.

use crate::interrupt;
use crate::numbers::few;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use clap::ValueEnum;
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::transform;
use pompeiu::core::run::{Limits, Progress};
use pompeiu::matching::align::{Fixed, Registration, RegistrationOptions, register};
use std::path::Path;

/// What may be done to B before it is compared with A.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Before {
    /// Rotate and translate
    Rigid,
}

impl Before {
    /// Moves B onto A.
    pub(crate) fn align(
        self,
        [a_path, b_path]: [&Path; 2],
        [a, b]: [&TriMesh; 2],
        limits: &Limits,
        wait: &Wait,
        printer: &Printer,
    ) -> anyhow::Result<(TriMesh, Registration)> {
        let show = |progress: &Progress<'_>| {
            wait.progress(progress);
            interrupt::flow()
        };
        let Self::Rigid = self;
        let options = RegistrationOptions {
            limits: Limits { memory: None, ..limits.clone() },
            progress: Some(&show),
            ..RegistrationOptions::default()
        };
        let fixed = Fixed::new(a).with_context(|| a_path.display().to_string())?;
        let found = register(b, &fixed, &options).with_context(|| b_path.display().to_string())?;
        let moved = transform(b, &found.map()).with_context(|| b_path.display().to_string())?;
        wait.restart();
        wait.suspend(|| warn([a_path, b_path], &found, printer));
        Ok((moved, found))
    }
}

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
            "ALIGNED, but {} fit nearly as well: the shape may be symmetric",
            counted(others, "other place")
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

fn counted(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}
