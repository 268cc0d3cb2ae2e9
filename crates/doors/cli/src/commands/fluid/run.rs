//! Runs the command.

use super::args::Fluid as Args;
use super::checkpoint::Checkpoint;
use super::scene::Scene;
use super::stage::Stage;
use super::{build, json, square, text};
use crate::called::called;
use crate::exit::Exit;
use crate::pair::File;
use crate::printer::Printer;
use crate::series::Series;
use crate::wait::Wait;
use crate::{files, interrupt, surface};
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::run::{Control, Limits, StopReason};
use pompeiu::figures::View;
use pompeiu::fluid::show::{FluidFrame, FluidPage, Streaks, most_frames};
use pompeiu::fluid::{FluidStep, FluidTiming, SchemeReport};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    /// At first and after each step.
    pub(super) steps: Vec<FluidStep>,
    pub(super) asked: usize,
    pub(super) stop: StopReason,
    pub(super) scheme: SchemeReport,
    pub(super) timing: FluidTiming,
    pub(super) total: Duration,
}

/// How long a run may be that is lost at most, where a checkpoint is asked for.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_mins(1);

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let scene = Scene::of(args)?;
    let Some(asked) = scene.steps else { bail!("no number of steps is given; name one with --steps") };
    let pages = || args.video.iter().map(PathBuf::as_path).chain(args.picture.outputs());
    let outputs = args.output.iter().chain(&args.checkpoint).map(PathBuf::as_path).chain(pages());
    let inputs = args.mesh.iter().chain(&args.scene).chain(&scene.obstacles).chain(&args.resume);
    files::check_places(outputs, &inputs.map(PathBuf::as_path).collect::<Vec<_>>())?;
    if let Some(folder) = args.frames.as_deref().filter(|folder| folder.exists()) {
        bail!("{}: exists; name a folder that does not, the frames go into it", folder.display());
    }
    let series = args.output.as_deref().map(Series::new).transpose()?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let name = if args.square.is_some() {
        Path::new("square")
    } else {
        args.mesh.as_deref().unwrap_or(Path::new(""))
    };
    let (mesh, surface) = if let Some(cells) = args.square {
        (square::centres(cells)?, None)
    } else {
        let (mesh, surface) = surface::read(name, &wait, printer)?;
        (mesh, Some(surface))
    };
    wait.show("factoring".to_owned());
    let made = match (&surface, args.square) {
        (Some(surface), _) => build::simulation(&scene, &mesh, surface, printer).map(|fluid| {
            Stage::Surface { fluid: Box::new(fluid), surface, streaks: Box::new(Streaks::new(surface)) }
        }),
        (None, cells) => square::simulation(&scene, cells.unwrap_or(0), &mesh)
            .map(|square| Stage::Square(Box::new(square))),
    };
    let mut stage = made.with_context(|| name.display().to_string())?;
    let shows = args.frames.is_some() || pages().next().is_some();
    let mut frames: Vec<FluidFrame> = Vec::new();
    let values = 1 + stage.scheme().densities.len();
    let stride =
        if shows { asked.div_ceil(most_frames(mesh.positions().len(), values)).max(1) } else { asked };
    let limits = Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() };
    let control = Control::start(&limits);
    let mut steps = match &args.resume {
        Some(path) => Checkpoint::resume(path, &mut stage, &mesh)?.steps,
        None => vec![stage.measure()?],
    };
    if steps.len() > asked + 1 {
        let done = steps.len() - 1;
        bail!("{done} steps are done already and --steps is {asked}; it counts from the beginning");
    }
    let mut failed = None;
    let mut saved = Instant::now();
    loop {
        let done = steps.len() - 1;
        if shows && (done.is_multiple_of(stride) || done == asked) {
            frames.push(stage.frame());
        }
        if let Some(series) = series.as_ref().filter(|_| done.is_multiple_of(args.every.get()))
            && series.add(done, stage.time(), |path| stage.write(path, &mesh)).is_break()
        {
            break;
        }
        if done == asked {
            break;
        }
        if let Some(path) = args.checkpoint.as_ref().filter(|_| saved.elapsed() >= BETWEEN_CHECKPOINTS) {
            Checkpoint::write(path, &stage, &mesh, &steps, printer)?;
            saved = Instant::now();
        }
        if interrupt::flow().is_break() {
            control.stop(StopReason::Cancelled);
        }
        if control.is_stopped() {
            break;
        }
        wait.count(format!("steps, time {:.4}", stage.time()), [done as u64, asked as u64]);
        match stage.step() {
            Ok(step) => steps.push(step),
            Err(error) => {
                failed = Some(error);
                break;
            }
        }
    }
    drop(wait);
    // What has been computed is kept, whatever ended the run.
    if let Some(series) = series {
        series.finish(printer)?;
    }
    if let Some(path) = &args.checkpoint {
        Checkpoint::write(path, &stage, &mesh, &steps, printer)?;
    }
    if let Some(error) = failed {
        return Err(error).with_context(|| name.display().to_string());
    }
    if shows && frames.last().is_some_and(|frame| frame.step + 1 != steps.len()) {
        frames.push(stage.frame());
    }
    let outcome = Outcome {
        input: File::new(name, &mesh),
        asked,
        stop: control.reason().unwrap_or(StopReason::Steps),
        scheme: stage.scheme(),
        timing: stage.timing(),
        steps,
        total: started.elapsed(),
    };
    show(args, &mesh, &outcome, &frames, printer)?;
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if outcome.steps.len() > asked { Exit::Done } else { Exit::Undecided })
}

/// Writes the page and the pictures.
fn show(
    args: &Args,
    mesh: &TriMesh,
    outcome: &Outcome,
    frames: &[FluidFrame],
    printer: &Printer,
) -> anyhow::Result<()> {
    let page = FluidPage {
        path: &outcome.input.path,
        mesh,
        scheme: &outcome.scheme,
        steps: &outcome.steps,
        frames,
        up: args.square.is_none().then(|| args.picture.up.axis()),
        command: Some(&called()),
    };
    if let Some(video) = &args.video {
        files::write_whole(video, page.html()?.as_bytes(), printer)?;
    }
    let last = frames.len().saturating_sub(1);
    args.picture.write(
        || page.html(),
        |width, height, theme, view| page.image(last, width, height, theme, front(args, view)),
        printer,
    )?;
    if let Some(folder) = &args.frames {
        std::fs::create_dir(folder).with_context(|| folder.display().to_string())?;
        for frame in 0..frames.len() {
            let png = args.picture.png(|width, height, theme, view| {
                page.image(frame, width, height, theme, front(args, view))
            })?;
            pompeiu::io::write_whole(folder.join(format!("frame-{frame:05}.png")), &png)?;
        }
        printer.note(format_args!("{}: {} pictures", folder.display(), frames.len()));
    }
    Ok(())
}

/// The square is looked at from the front, unless somebody wants it otherwise.
fn front(args: &Args, view: View) -> View {
    if args.square.is_some() && args.picture.from.is_none() {
        view.with_direction_to_eye([0.0, 0.0, 1.0])
    } else {
        view
    }
}
