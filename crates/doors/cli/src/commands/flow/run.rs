//! Runs the command.

use super::args::{Flow as Args, Volume};
use super::{json, text};
use crate::args::tell;
use crate::called::called;
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::pair::File;
use crate::printer::Printer;
use crate::series::Series;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::run::{Limits, Progress};
use pompeiu::flow::show::{FlowPage, Frames};
use pompeiu::flow::{
    BoundaryCondition, Flow, FlowObserver, FlowOptions, FlowStep, FlowStop, Remeshing, mean_curvature_flow,
};
use pompeiu::io::{Attributes, write_with};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Surfaces that a page plays at most.
const MOST_FRAMES: usize = 120;

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) input: File,
    pub(super) output: File,
    pub(super) flow: Flow,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && args.series.is_none() && args.picture.outputs().next().is_none() && !args.json
    {
        bail!(
            "nothing would be written; name the result with -o, or ask for --series, --report, --image or --json"
        );
    }
    if let Some(output) = &args.output {
        files::check_writable(output)?;
    }
    let outputs = args.output.iter().chain(&args.series).map(PathBuf::as_path).chain(args.picture.outputs());
    files::check_places(outputs, &[&args.mesh])?;
    let series = args.series.as_deref().map(Series::new).transpose()?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let mesh = files::read_shown(&args.mesh, &wait, printer)?;
    let shows = args.picture.outputs().next().is_some();
    let frames = Frames::new(if shows { MOST_FRAMES } else { 2 });
    let watch = |step: &FlowStep<'_>| {
        let doing = format!("step {}, area {:.6}", step.step, step.record.area);
        match step.share {
            Some(_) => wait.progress(&Progress { doing: &doing, share: step.share }),
            None => wait.show(doing),
        }
        if shows {
            frames.step(step)?;
        }
        if let Some(series) = &series {
            // Steps without a length in time are counted.
            let time = step.record.time.unwrap_or(step.step as f64);
            series.add(step.step, time, |path| write_step(path, step))?;
        }
        interrupt::flow()
    };
    let options = FlowOptions {
        scheme: args.scheme,
        time_step: args.time_step,
        boundary: args.planes.map_or(BoundaryCondition::Fixed, BoundaryCondition::Planes),
        keep_volume: args.volume == Volume::Keep,
        remesh: args.remesh.map(|edge_length| Remeshing { edge_length, every: args.remesh_every }),
        coordinates: args.output.as_deref().map(|path| args.centered.coordinates(path)).unwrap_or_default(),
        intersections: args.guard.intersections.into(),
        limits: Limits { time: args.limits.time_after(started.elapsed()), ..Limits::default() },
        observer: Some(&watch),
        ..FlowOptions::new(args.until)
    };
    let flow = mean_curvature_flow(&mesh, &options).with_context(|| args.mesh.display().to_string())?;
    drop(wait);
    if let Some(series) = series {
        series.finish(printer)?;
    }
    if let Some(output) = &args.output {
        tell(output, &flow.rounding, printer);
        files::write_rounded(output, &flow.mesh, &flow.rounding, printer)?;
    }
    let page = FlowPage {
        path: &args.mesh.display().to_string(),
        flow: &flow,
        frames: &frames.into_frames(),
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
        output: File::new(args.output.as_deref().unwrap_or(&args.mesh), &flow.mesh),
        flow,
        total: started.elapsed(),
    };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(match outcome.flow.stop {
        FlowStop::Stationary | FlowStop::Time | FlowStop::Steps | FlowStop::Pinched => Exit::Done,
        _ => Exit::Undecided,
    })
}

/// Writes the surface after a step.
fn write_step(path: &Path, step: &FlowStep<'_>) -> anyhow::Result<()> {
    let mesh = TriMesh::new(step.positions.to_vec(), step.faces.to_vec())?;
    Ok(write_with(path, &mesh, &Attributes::for_mesh(&mesh))?)
}
