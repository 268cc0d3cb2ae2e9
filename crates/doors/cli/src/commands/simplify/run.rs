//! Runs the command.

use super::appearance::{Appearance, Kept};
use super::args::{Effort as Asked, Simplify};
use super::{json, text};
use crate::args::tell;
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::geom::Aabb;
use pompeiu::core::run::{Limits, Progress};
use pompeiu::remesh::{Effort, Features, Simplified, SimplifyOptions, SimplifyTarget, simplify_levels};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    /// What was written, as asked for first, and then finer and finer.
    pub(super) levels: Vec<(File, Simplified)>,
    pub(super) kept: Kept,
    pub(super) total: Duration,
}

impl Outcome {
    /// The level that was asked for.
    pub(super) fn asked(&self) -> &(File, Simplified) {
        &self.levels[0]
    }
}

/// The distance that a level keeps.
pub(super) fn within(found: &Simplified) -> Option<f64> {
    match found.target {
        SimplifyTarget::Within(d) => Some(d),
        SimplifyTarget::Faces(_) => None,
    }
}

/// Where a level goes: the first to the path itself, others with their number before the suffix.
fn place(path: &Path, level: usize) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match name.split_once('.') {
        Some((stem, suffix)) if level > 0 => path.with_file_name(format!("{stem}-{level}.{suffix}")),
        _ => path.to_owned(),
    }
}

pub(crate) fn run(args: &Simplify, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let places: Vec<PathBuf> =
        (0..usize::from(args.levels)).map(|level| place(&args.output, level)).collect();
    for place in &places {
        files::check_writable(place)?;
    }
    files::check_places(places.iter().map(PathBuf::as_path), &[&args.mesh])?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let mesh = files::read_shown(&args.mesh, &wait, printer)?;
    let appearance = Appearance::read(&args.mesh, &mesh, &args.output, args.repair, printer)?;
    let within = args.within.or_else(|| args.relative.map(|share| share * Aabb::of_faces(&mesh).diagonal()));
    let target = within.map_or(SimplifyTarget::Faces(args.faces.unwrap_or(0)), SimplifyTarget::Within);
    let show = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let limits = Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() };
    let options = SimplifyOptions {
        features: Features { angle: args.features, edges: &appearance.seams, ..Features::default() },
        effort: match args.effort {
            Asked::Best => Effort::Best,
            Asked::Fast => Effort::Fast,
        },
        repair: args.repair,
        coordinates: args.centered.coordinates(&args.output),
        intersections: args.guard.intersections.into(),
        limits,
        progress: Some(&show),
        ..SimplifyOptions::new(target)
    };
    let mut found = simplify_levels(&mesh, &options, usize::from(args.levels))
        .with_context(|| args.mesh.display().to_string())?;
    drop(wait);
    found.reverse();
    let mut levels = Vec::new();
    if let Some(level) = found.first() {
        tell(&args.output, &level.rounding, printer);
    }
    for (place, level) in places.iter().zip(found) {
        appearance.write(place, &level, printer)?;
        levels.push((File::new(place, &level.mesh), level));
    }
    let (input, kept) = (File::new(&args.mesh, &mesh), appearance.kept());
    let outcome = Outcome { input, levels, kept, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    let early = outcome.levels.iter().any(|(_, level)| level.stop.is_early());
    Ok(if early { Exit::Undecided } else { Exit::Done })
}
