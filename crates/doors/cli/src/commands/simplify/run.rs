//! Runs the command.

use super::args::Simplify;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::geom::Aabb;
use pompeiu::core::run::{Limits, Progress};
use pompeiu::flow::remesh::{Simplified, SimplifyOptions, SimplifyTarget, simplify};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) output: File,
    /// The distance asked for.
    pub(super) within: Option<f64>,
    pub(super) found: Simplified,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Simplify, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    files::check_writable(&args.output)?;
    files::check_place(&args.output, &[&args.mesh])?;
    args.limits.apply_threads()?;
    let wait = Wait::new(printer);
    wait.show(format!("reading {}", args.mesh.display()));
    let read = files::read(&args.mesh)?;
    wait.suspend(|| files::warn_of_changes(&args.mesh, &read, printer));
    let mesh = read.mesh;
    let within = args.within.or_else(|| args.relative.map(|share| share * Aabb::of_faces(&mesh).diagonal()));
    let target = within.map_or(SimplifyTarget::Faces(args.faces.unwrap_or(0)), SimplifyTarget::Within);
    let show = |progress: &Progress<'_>| {
        let done = (progress.share.unwrap_or(0.0) * 1000.0) as u64;
        wait.advance(progress.doing.to_owned(), [done, 1000]);
        ControlFlow::Continue(())
    };
    let limits = Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() };
    let options = SimplifyOptions { limits, progress: Some(&show), ..SimplifyOptions::new(target) };
    let found = simplify(&mesh, &options).with_context(|| args.mesh.display().to_string())?;
    drop(wait);
    files::write(&args.output, &found.mesh, printer)?;
    let outcome = Outcome {
        input: File::new(&args.mesh, &mesh),
        output: File::new(&args.output, &found.mesh),
        within,
        found,
        total: started.elapsed(),
    };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(Exit::Done)
}
