//! Runs the stage of transport, and the whole.

use super::args::Transport as Args;
use super::checkpoint::{self, Checkpoint};
use super::source::Source;
use super::{json, text};
use crate::called::called;
use crate::exit::{Exit, stopped_by};
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::series::Series;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Progress, StopReason};
use pompeiu::neuron::{
    Cap, Frame, NeuronPage, NeuronReport, NeuronSurface, Parameters, Timing, Transport, TransportOptions,
    TransportState, read_transport_config, transport,
};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(super) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let (input, series) = outputs(args)?;
    let parameters = parameters(args.config.as_deref())?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let path = input.display().to_string();
    let fingerprint = fingerprint(args, "transport")?;
    let resumed = resumed(args, &fingerprint, &parameters)?;
    let (source, skeleton) = Source::read(&args.skeleton)?;
    let skeleton_time = milliseconds(started.elapsed());
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let limits = args.limits.after(started.elapsed());
    let mesh =
        source.hexahedra(&args.blocks, &parameters.sides, limits, &watch).with_context(|| path.clone())?;
    let mesh_time = milliseconds(started.elapsed()) - skeleton_time;
    wait.restart();
    let limits = args.limits.after(started.elapsed());
    let options = TransportOptions { limits, progress: Some(&watch), resume: resumed.as_ref() };
    let found =
        transport(&mesh, &parameters, args.frames as usize, &options).with_context(|| path.clone())?;
    drop(wait);
    let timing = Timing {
        skeleton: skeleton_time,
        mesh: Some(mesh_time),
        transport: Some(milliseconds(started.elapsed()) - skeleton_time - mesh_time),
        ..Timing::default()
    };
    let report = NeuronReport {
        skeleton,
        mesh: Some(mesh.report.clone()),
        spline: None,
        flow: None,
        transport: Some(found.report.clone()),
        timing,
    };
    let cells = Moved {
        caps: &mesh.caps,
        inlet: found.inlet,
        surface: &|| NeuronSurface::new(&mesh),
        bytes: &|frame| mesh.vtu_with(&frame.values),
    };
    let run = (started, parameters, fingerprint);
    finish(args, series, run, &cells, found, report, printer)
}

/// What was moved through some cells, to be written.
pub(super) struct Moved<'m> {
    pub(super) caps: &'m [Cap],
    pub(super) inlet: u32,
    pub(super) surface: &'m dyn Fn() -> NeuronSurface,
    pub(super) bytes: &'m dyn Fn(&Frame) -> std::io::Result<Vec<u8>>,
}

/// Checks that something is to be written, and that nothing is in the way; gives the input and the collection.
pub(super) fn outputs(args: &Args) -> anyhow::Result<(&Path, Option<Series>)> {
    let outputs = || [&args.output, &args.tips, &args.report, &args.checkpoint].into_iter().flatten();
    if outputs().next().is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --report, --tips or --json");
    }
    let input = args.skeleton.skeleton.as_path();
    // A checkpoint may be written over the one that it began from.
    let inputs = [Some(input), args.config.as_deref()];
    let inputs: Vec<&Path> = inputs.into_iter().flatten().collect();
    files::check_places(outputs().map(PathBuf::as_path), &inputs)?;
    Ok((input, args.output.as_deref().map(|list| Series::of(list, "vtu")).transpose()?))
}

/// What cells depend on, for a checkpoint.
pub(super) fn fingerprint(args: &Args, stage: &str) -> anyhow::Result<String> {
    let (choice, blocks) = (&args.skeleton, &args.blocks);
    let options = choice.preparation().line(stage, blocks.parts.into(), blocks.layer);
    checkpoint::fingerprint(&choice.skeleton, &options)
}

/// The state to go on from.
pub(super) fn resumed(
    args: &Args,
    fingerprint: &str,
    parameters: &Parameters,
) -> anyhow::Result<Option<TransportState>> {
    let read = |path: &PathBuf| Ok(Checkpoint::read(path, fingerprint, parameters)?.state);
    args.resume.as_ref().map(read).transpose()
}

/// Writes what was asked for, and answers.
pub(super) fn finish(
    args: &Args,
    series: Option<Series>,
    (started, parameters, fingerprint): (Instant, Parameters, String),
    cells: &Moved<'_>,
    found: Transport,
    mut report: NeuronReport,
    printer: &Printer,
) -> anyhow::Result<Exit> {
    let path = args.skeleton.skeleton.display().to_string();
    if let Some(series) = series {
        write_frames(series, &found.state.frames, printer, cells.bytes)?;
    }
    if let Some(tips) = &args.tips {
        files::write_whole(tips, table(cells.caps, &parameters, &found).as_bytes(), printer)?;
    }
    if let Some(place) = &args.report {
        let page = NeuronPage {
            path: &path,
            surface: &(cells.surface)(),
            caps: cells.caps,
            inlet: cells.inlet,
            parameters: &parameters,
            state: &found.state,
            report: &report,
            command: Some(&called()),
        };
        files::write_whole(place, page.html()?.as_bytes(), printer)?;
    }
    let complete = found.stop == StopReason::Steps;
    if !complete {
        let done = found.report.steps;
        printer.warning(format_args!("stopped early by {} after {done} steps", stopped_by(found.stop)));
    }
    if let Some(place) = &args.checkpoint {
        Checkpoint::write(place, &fingerprint, &parameters, found.state, printer)?;
    }
    report.timing.total = milliseconds(started.elapsed());
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    let certified = report.mesh.is_none_or(|mesh| mesh.certified);
    Ok(if certified && complete { Exit::Done } else { Exit::Undecided })
}

pub(super) fn parameters(config: Option<&Path>) -> anyhow::Result<Parameters> {
    let Some(config) = config else { return Ok(Parameters::default()) };
    files::check_readable(config)?;
    let shown = || config.display().to_string();
    let text = std::fs::read_to_string(config).with_context(shown)?;
    read_transport_config(&text).with_context(shown)
}

/// Writes a grid for each frame, and the collection that names them.
fn write_frames(
    series: Series,
    frames: &[Frame],
    printer: &Printer,
    bytes: &dyn Fn(&Frame) -> std::io::Result<Vec<u8>>,
) -> anyhow::Result<()> {
    for frame in frames {
        let write = |path: &Path| {
            let bytes = bytes(frame).with_context(|| path.display().to_string())?;
            Ok(pompeiu::io::write_whole(path, &bytes)?)
        };
        if series.add(frame.step, frame.time, write).is_break() {
            break;
        }
    }
    series.finish(printer)
}

/// Concentrations at the flat ends after each step.
fn table(caps: &[Cap], parameters: &Parameters, found: &Transport) -> String {
    let mut table = String::from("time,sample,free,plus,minus,total\n");
    for (step, ends) in found.state.ends.iter().enumerate() {
        let time = step as f64 * parameters.step;
        for (cap, [free, plus, minus]) in caps.iter().zip(ends) {
            let total = free + plus + minus;
            let _ = writeln!(table, "{time},{},{free},{plus},{minus},{total}", cap.sample);
        }
    }
    table
}
