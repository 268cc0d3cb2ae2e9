//! Runs the command.

use super::args::Fluid as Args;
use super::scene::Scene;
use super::{build, json, text};
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
use pompeiu::fluid::show::{FluidFrame, FluidPage, Streaks, most_frames};
use pompeiu::fluid::{FluidStep, FluidTiming, SchemeReport, Simulation};
use pompeiu::io::{Attributes, write_with};
use pompeiu::surface::EmbeddedSurface;
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

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let scene = Scene::of(args)?;
    let Some(asked) = scene.steps else { bail!("no number of steps is given; name one with --steps") };
    let pages = || args.video.iter().map(PathBuf::as_path).chain(args.picture.outputs());
    let outputs = args.output.iter().map(PathBuf::as_path).chain(pages());
    let inputs: Vec<&Path> = std::iter::once(&args.mesh).chain(&args.scene).map(PathBuf::as_path).collect();
    files::check_places(outputs, &inputs)?;
    if let Some(folder) = args.frames.as_deref().filter(|folder| folder.exists()) {
        bail!("{}: exists; name a folder that does not, the frames go into it", folder.display());
    }
    let series = args.output.as_deref().map(Series::new).transpose()?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let (mesh, surface) = surface::read(&args.mesh, &wait, printer)?;
    wait.show("factoring".to_owned());
    let mut fluid = build::named(build::simulation(&scene, &mesh, &surface, printer), &args.mesh)?;
    let streaks = Streaks::new(&surface);
    let shows = args.frames.is_some() || pages().next().is_some();
    let mut frames: Vec<FluidFrame> = Vec::new();
    let values = 1 + fluid.state().densities.len();
    let stride =
        if shows { asked.div_ceil(most_frames(mesh.positions().len(), values)).max(1) } else { asked };
    let limits = Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() };
    let control = Control::start(&limits);
    let mut steps = vec![fluid.measure()?];
    let mut failed = None;
    loop {
        let done = steps.len() - 1;
        if shows && (done.is_multiple_of(stride) || done == asked) {
            frames.push(FluidFrame::new(fluid.state(), &streaks));
        }
        if let Some(series) = series.as_ref().filter(|_| done.is_multiple_of(args.every.get())) {
            let write = |path: &Path| write_step(path, &mesh, &surface, &fluid);
            if series.add(done, fluid.state().time, write).is_break() {
                break;
            }
        }
        if done == asked {
            break;
        }
        if interrupt::flow().is_break() {
            control.stop(StopReason::Cancelled);
        }
        if control.is_stopped() {
            break;
        }
        let time = fluid.state().time;
        wait.count(format!("steps, time {time:.4}"), [done as u64, asked as u64]);
        match fluid.step() {
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
    if let Some(error) = failed {
        return Err(error).with_context(|| args.mesh.display().to_string());
    }
    if shows && frames.last().is_some_and(|frame| frame.step != fluid.state().step) {
        frames.push(FluidFrame::new(fluid.state(), &streaks));
    }
    let outcome = Outcome {
        input: File::new(&args.mesh, &mesh),
        asked,
        stop: control.reason().unwrap_or(StopReason::Steps),
        scheme: fluid.scheme(),
        timing: fluid.timing(),
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
        path: &args.mesh.display().to_string(),
        mesh,
        scheme: &outcome.scheme,
        steps: &outcome.steps,
        frames,
        up: args.picture.up.axis(),
        command: Some(&called()),
    };
    if let Some(video) = &args.video {
        files::write_whole(video, page.html()?.as_bytes(), printer)?;
    }
    let last = frames.len().saturating_sub(1);
    args.picture.write(
        || page.html(),
        |width, height, theme, view| page.image(last, width, height, theme, view),
        printer,
    )?;
    if let Some(folder) = &args.frames {
        std::fs::create_dir(folder).with_context(|| folder.display().to_string())?;
        for frame in 0..frames.len() {
            let png = args
                .picture
                .png(|width, height, theme, view| page.image(frame, width, height, theme, view))?;
            pompeiu::io::write_whole(folder.join(format!("frame-{frame:05}.png")), &png)?;
        }
        printer.note(format_args!("{}: {} pictures", folder.display(), frames.len()));
    }
    Ok(())
}

/// Writes the flow as it is.
fn write_step(
    path: &Path,
    mesh: &TriMesh,
    surface: &EmbeddedSurface,
    fluid: &Simulation<'_>,
) -> anyhow::Result<()> {
    let state = fluid.state();
    let velocity = state.velocity.entries().map(|(face, &u)| surface.to_space(face, u)).collect();
    let mut attributes = Attributes::for_mesh(mesh)
        .with_vertex_scalar("vorticity", state.vorticity.to_vec())?
        .with_vertex_scalar("stream_function", state.stream.to_vec())?
        .with_face_vector("velocity", velocity)?;
    for (name, values) in fluid.scheme().densities.iter().zip(&state.densities) {
        attributes = attributes.with_vertex_scalar(name, values.to_vec())?;
    }
    Ok(write_with(path, mesh, &attributes)?)
}
