//! Runs the command.

use super::args::Medial as Args;
use super::{json, text};
use crate::called::called;
use crate::exit::Exit;
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, surface};
use anyhow::{Context, bail};
use pompeiu::core::run::Limits;
use pompeiu::flatten::show::MedialPage;
use pompeiu::flatten::{Medial, MedialOptions, medial_balls};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) medial: Medial,
    /// From the command's start to its answer.
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && args.picture.outputs().next().is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --report, --image or --json");
    }
    let is = |path: &Path, suffix: &str| {
        path.extension().is_some_and(|found| found.eq_ignore_ascii_case(OsStr::new(suffix)))
    };
    if let Some(output) = args.output.as_deref().filter(|path| !is(path, "ma") && !is(path, "png")) {
        files::check_writable(output)?;
    }
    let outputs = args.output.iter().map(PathBuf::as_path).chain(args.picture.outputs());
    files::check_places(outputs, &[&args.mesh])?;
    args.limits.apply_threads()?;
    let shown = args.mesh.display().to_string();
    let wait = Wait::new(printer);
    let (mesh, surface) = surface::read(&args.mesh, &wait, printer)?;
    wait.show("finding balls".to_owned());
    let options = MedialOptions {
        balls: args.balls,
        samples: args.samples,
        tolerance: args.tolerance,
        limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
    };
    let medial = medial_balls(&surface, &options).with_context(|| shown.clone())?;
    drop(wait);
    let command = called();
    let mut page = MedialPage::new(&shown, &mesh, &medial)?;
    (page.up, page.command) = (args.picture.up.axis(), Some(command.as_str()));
    if let Some(output) = &args.output {
        if is(output, "ma") {
            files::write_whole(output, medial.to_ma().as_bytes(), printer)?;
        } else if is(output, "png") {
            args.picture.write_image(
                output,
                |width, height, theme, view| page.image(width, height, theme, view),
                printer,
            )?;
        } else {
            files::write(output, &medial.spheres()?, printer)?;
        }
    }
    args.picture.write(
        || page.html(),
        |width, height, theme, view| page.image(width, height, theme, view),
        printer,
    )?;
    drop(page);
    let outcome = Outcome { input: File::new(&args.mesh, &mesh), medial, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if outcome.medial.stop.is_early() { Exit::Undecided } else { Exit::Done })
}
