//! Runs the command.

use super::args::Align;
use super::{json, text};
use crate::args::tell;
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::numbers::shortest;
use crate::pair::{self, File};
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::geom::Aabb;
use pompeiu::core::mesh::{Coordinates, transform};
use pompeiu::core::run::{Limits, Progress};
use pompeiu::hausdorff::{HausdorffOptions, SymmetricReport};
use pompeiu::io::OutputFormat;
use pompeiu::matching::align::{Fixed, Registration, RegistrationOptions, register};
use std::fmt::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Outcome {
    pub(super) moving: File,
    pub(super) fixed: File,
    pub(super) found: Registration,
    /// From the moved mesh to the fixed one, and back.
    pub(super) distance: SymmetricReport,
    pub(super) read: Duration,
    pub(super) aligned: Duration,
    pub(super) measured: Duration,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Align, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    pair::check(&args.moving, &args.fixed, printer)?;
    if let Some(path) = &args.output {
        files::check_writable(path)?;
    }
    let outputs = [&args.output, &args.matrix].into_iter().flatten().map(PathBuf::as_path);
    files::check_places(outputs, &[&args.moving, &args.fixed])?;
    args.limits.apply_threads()?;
    let wait = Wait::new(printer);
    let (moving, fixed) = pair::read(&args.moving, &args.fixed, (&args.limits, started), &wait, printer)?;
    let read = started.elapsed();
    interrupt::listen();
    let show = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let options = RegistrationOptions {
        scale: args.scale,
        overlap: args.robust,
        limits: Limits { memory: None, ..args.limits.after(read) },
        progress: Some(&show),
    };
    let prepared = Fixed::new(&fixed).with_context(|| args.fixed.display().to_string())?;
    let found = register(&moving, &prepared, &options).with_context(|| args.moving.display().to_string())?;
    let aligned = started.elapsed();
    wait.show("measuring the distance".to_owned());
    let moved = transform(&moving, &found.map()).with_context(|| args.moving.display().to_string())?;
    // What is said of the distance is true of the file.
    let precision = args.output.as_deref().and_then(OutputFormat::from_path).map(OutputFormat::precision);
    let coordinates = Coordinates { precision: precision.unwrap_or_default(), centered: false };
    let grid = coordinates.within(&Aabb::of_faces(&moved));
    let rounding = grid.rounding(&moved);
    let moved = grid.round_mesh(&moved)?;
    let limits = args.limits.after(aligned);
    let distance = HausdorffOptions { limits, ..HausdorffOptions::default() }.symmetric(&moved, &fixed)?;
    let measured = started.elapsed();
    drop(wait);
    if let Some(path) = &args.output {
        tell(path, &rounding, printer);
        files::write(path, &moved, printer)?;
    }
    if let Some(path) = &args.matrix {
        files::write_whole(path, rows(&found).as_bytes(), printer)?;
    }
    let outcome = Outcome {
        moving: File::new(&args.moving, &moving),
        fixed: File::new(&args.fixed, &fixed),
        found,
        distance,
        read,
        aligned: aligned.saturating_sub(read),
        measured: measured.saturating_sub(aligned),
        total: started.elapsed(),
    };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    let found = &outcome.found;
    let early = found.stop.is_early()
        || [&outcome.distance.a_to_b, &outcome.distance.b_to_a].iter().any(|d| d.stop.is_early());
    Ok(if early || !found.fits { Exit::Undecided } else { Exit::Done })
}

/// The matrix as text.
pub(super) fn rows(found: &Registration) -> String {
    let mut text = String::new();
    for row in found.matrix {
        let _ = writeln!(text, "{}", row.map(shortest).join(" "));
    }
    text
}
