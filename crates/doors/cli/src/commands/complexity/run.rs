//! Runs the command.

use super::args::Complexity as Args;
use super::{input, json, text};
use crate::called::called;
use crate::exit::Exit;
use crate::many::Problem;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::bail;
use pompeiu::complexity::show::ComplexityPage;
use pompeiu::complexity::{AnalyseOptions, ComplexityReport, Measure, MeasureOptions, analyse};
use pompeiu::core::run::{Limits, Progress};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What was found, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) report: ComplexityReport,
    pub(super) problems: Vec<Problem>,
    /// From the command's start to its answer.
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    // Wrong names are told before any file is read.
    for name in std::iter::once(&args.rank_by).chain(&args.features) {
        Measure::named(name.strip_prefix("log:").unwrap_or(name))?;
    }
    args.limits.apply_threads()?;
    let against = args.against.as_deref().map(input::ranking).transpose()?;
    let (paths, mut problems) = input::expand(&args.inputs);
    let read: Vec<_> = paths.iter().chain(&args.against).map(PathBuf::as_path).collect();
    files::check_places(args.report.as_deref(), &read)?;
    interrupt::listen();
    let wait = Wait::new(printer);
    wait.show("reading shapes".to_owned());
    let (shapes, unusable) = input::read(&paths, &args.silhouette.options());
    problems.extend(unusable);
    if shapes.is_empty() {
        drop(wait);
        Problem::report(&problems);
        bail!("there are no shapes to measure");
    }
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let options = AnalyseOptions {
        measure: MeasureOptions { smoothing: args.smoothing },
        rank_by: args.rank_by.clone(),
        against,
        clusters: args.clusters,
        features: args.features.clone(),
        limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
        progress: Some(&watch),
    };
    let report = analyse(&shapes, &options)?;
    drop(wait);
    Problem::report(&problems);
    if let Some(path) = &args.report {
        let title =
            args.inputs.iter().map(|input| input.display().to_string()).collect::<Vec<_>>().join(", ");
        let page =
            ComplexityPage { title: &title, shapes: &shapes, report: &report, command: Some(&called()) };
        files::write_whole(path, page.html()?.as_bytes(), printer)?;
    }
    let outcome = Outcome { report, problems, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(match (outcome.problems.is_empty(), outcome.report.stop.is_early()) {
        (false, _) => Exit::Unusable,
        (true, true) => Exit::Undecided,
        (true, false) => Exit::Done,
    })
}
