//! Runs the command.

use super::args::Flatten as Args;
use super::output::{Kind, kind, write_textured};
use super::{json, text};
use crate::called::called;
use crate::exit::Exit;
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt, surface};
use anyhow::{Context, bail};
use pompeiu::core::run::{Limits, Progress};
use pompeiu::flatten::show::{FlattenPage, layout_svg};
use pompeiu::flatten::{CutOptions, CutStrategy, FlattenOptions, FlattenReport, flatten, straighten};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) report: FlattenReport,
    /// From the command's start to its answer.
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && args.picture.outputs().next().is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --report, --image or --json");
    }
    let kind = args.output.as_deref().map(kind).transpose()?;
    let outputs = args.output.iter().map(PathBuf::as_path).chain(args.picture.outputs());
    files::check_places(outputs, &[&args.mesh])?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let shown = || args.mesh.display().to_string();
    let wait = Wait::new(printer);
    let (mut mesh, mut surface) = surface::read(&args.mesh, &wait, printer)?;
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let options = FlattenOptions {
        cut: args.cut.options(&surface)?,
        method: args.method(),
        target: args.target,
        most_cuts: args.most_cuts,
        pack: !args.no_pack,
        limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
        progress: Some(&watch),
    };
    let mut flat = flatten(&surface, &options).with_context(shown)?;
    if args.cut.straighten {
        let straight = straighten(&surface, &flat.cut).with_context(shown)?;
        let strategy = CutStrategy::Along(straight.paths());
        let options =
            FlattenOptions { cut: CutOptions { strategy, ..CutOptions::default() }, ..options.clone() };
        let chosen = flat.report.cut.strategy;
        flat = flatten(&straight.surface, &options).with_context(shown)?;
        flat.report.cut.strategy = chosen;
        (mesh, surface) = (straight.mesh, straight.surface);
    }
    drop(wait);
    let page = FlattenPage {
        path: &shown(),
        surface: &surface,
        flat: &flat,
        up: args.picture.up.axis(),
        command: Some(&called()),
    };
    if let (Some(output), Some(kind)) = (&args.output, kind) {
        match kind {
            Kind::Textured(format) => write_textured(output, format, &mesh, &flat, printer)?,
            Kind::Drawing => files::write_whole(output, layout_svg(&surface, &flat).as_bytes(), printer)?,
            Kind::Picture => {
                args.picture.write_image(
                    output,
                    |width, height, theme, view| page.image(width, height, theme, view),
                    printer,
                )?;
            }
        }
    }
    args.picture.write(
        || page.html(),
        |width, height, theme, view| page.image(width, height, theme, view),
        printer,
    )?;
    let outcome =
        Outcome { input: File::new(&args.mesh, &mesh), report: flat.report, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if outcome.report.is_one_to_one() && !outcome.report.stop.is_early() {
        Exit::Done
    } else {
        Exit::Undecided
    })
}
