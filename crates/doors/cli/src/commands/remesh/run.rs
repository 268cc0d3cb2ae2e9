//! Runs the command.

use super::args::Remesh;
use super::{json, text};
use crate::args::tell;
use crate::called::called;
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::geom::Aabb;
use pompeiu::core::run::{Limits, Progress};
use pompeiu::remesh::show::RemeshPage;
use pompeiu::remesh::{Features, RemeshOptions, Remeshed, Sizing, remesh};
use std::time::{Duration, Instant};

/// Least and greatest length of edges that follow curvature, as fractions of the diagonal.
const ADAPTIVE_BETWEEN: [f64; 2] = [1e-4, 0.1];

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) output: File,
    /// The length asked for.
    pub(super) edge_length: Option<f64>,
    /// The height asked for.
    pub(super) chord_height: Option<f64>,
    /// The distance asked for.
    pub(super) within: Option<f64>,
    pub(super) found: Remeshed,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Remesh, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    files::check_writable(&args.output)?;
    let outputs = std::iter::once(args.output.as_path()).chain(args.picture.outputs());
    files::check_places(outputs, &[&args.mesh])?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let mesh = files::read_shown(&args.mesh, &wait, printer)?;
    let diagonal = Aabb::of_faces(&mesh).diagonal();
    let edge_length = args.edge_length.or_else(|| args.relative.map(|share| share * diagonal));
    let sizing = match (edge_length, args.adaptive) {
        (None, Some(tolerance)) => {
            Sizing::ChordHeight { tolerance, between: ADAPTIVE_BETWEEN.map(|share| share * diagonal) }
        }
        (length, _) => Sizing::Length(length.unwrap_or(0.0)),
    };
    let show = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let options = RemeshOptions {
        features: Features { angle: args.features, ..Features::default() },
        iterations: args.iterations,
        within: args.within,
        most_faces: args.most_faces,
        coordinates: args.centered.coordinates(&args.output),
        intersections: args.guard.intersections.into(),
        limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
        progress: Some(&show),
        ..RemeshOptions::new(sizing)
    };
    let found = remesh(&mesh, &options).with_context(|| args.mesh.display().to_string())?;
    drop(wait);
    tell(&args.output, &found.rounding, printer);
    files::write_rounded(&args.output, &found.mesh, &found.rounding, printer)?;
    let page = RemeshPage {
        path: &args.mesh.display().to_string(),
        input: &mesh,
        found: &found,
        up: args.picture.up.axis(),
        command: Some(&called()),
    };
    args.picture.write(
        || page.html(),
        |width, height, theme, view| page.image(width, height, theme, view),
        printer,
    )?;
    let outcome = Outcome {
        input: File::new(&args.mesh, &mesh),
        output: File::new(&args.output, &found.mesh),
        edge_length,
        chord_height: args.adaptive,
        within: args.within,
        found,
        total: started.elapsed(),
    };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if outcome.found.stop.is_early() { Exit::Undecided } else { Exit::Done })
}
