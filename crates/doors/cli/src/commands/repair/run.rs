//! Runs the command.

use super::args::Repair;
use super::{json, text};
use crate::args::tell;
use crate::exit::Exit;
use crate::files;
use crate::numbers::shortest;
use crate::pair::File;
use crate::printer::Printer;
use anyhow::Context;
use pompeiu::core::mesh::Rounding;
use pompeiu::core::mesh::repair::{RepairOptions, RepairReport, Weld, repair};
use pompeiu::hausdorff::{Enclosure, symmetric_hausdorff};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) output: File,
    pub(super) report: RepairReport,
    pub(super) rounding: Rounding,
    /// The distance asked for, and the one found.
    pub(super) distance: Option<(f64, Enclosure)>,
    /// Whether the output was written.
    pub(super) written: bool,
}

pub(crate) fn run(args: &Repair, printer: &Printer) -> anyhow::Result<Exit> {
    files::check_writable(&args.output)?;
    files::check_place(&args.output, &[&args.input])?;
    let read = files::read(&args.input)?;
    files::warn_of_changes(&args.input, &read, printer);
    let weld = match args.weld {
        Some(length) if length > 0.0 => Weld::Within(length),
        None if args.no_weld => Weld::Never,
        _ => Weld::Equal,
    };
    let options = RepairOptions {
        weld,
        fill_holes: args.fill_holes,
        coordinates: args.centered.coordinates(&args.output),
    };
    let found = repair(&read.mesh, &options).with_context(|| args.input.display().to_string())?;
    let distance = args.within.map(|within| (within, symmetric_hausdorff(&read.mesh, &found.mesh).distance));
    let exit = match distance {
        Some((within, distance)) if distance.lower() > within => Exit::Above,
        Some((within, distance)) if distance.upper() > within => Exit::Undecided,
        _ => Exit::Done,
    };
    let outcome = Outcome {
        input: File::new(&args.input, &read.mesh),
        output: File::new(&args.output, &found.mesh),
        report: found.report,
        rounding: found.rounding,
        distance,
        written: exit == Exit::Done,
    };
    if outcome.written {
        tell(&args.output, &outcome.rounding, printer);
        files::write_rounded(&args.output, &found.mesh, &outcome.rounding, printer)?;
    } else if let Some((within, _)) = distance {
        printer.warning(format_args!(
            "{}: not written, for the result is not proven to be within {} of the input; allow more, or repair less",
            args.output.display(),
            shortest(within)
        ));
    }
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(exit)
}
