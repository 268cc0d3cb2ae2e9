//! Runs the stage of transport, and the whole.

use super::args::Transport as Args;
use super::run::{meshed, read};
use super::{json, text};
use crate::exit::{Exit, stopped_by};
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::series::Series;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Progress, StopReason};
use pompeiu::neuron::{
    Cap, Frame, NeuronReport, Parameters, Timing, Transport, TransportOptions, read_transport_config,
    transport,
};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(super) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && args.tips.is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --tips or --json");
    }
    let input = args.skeleton.skeleton.as_path();
    files::check_places(args.output.iter().chain(&args.tips).map(PathBuf::as_path), &[input])?;
    let series = args.output.as_deref().map(|list| Series::of(list, "vtu")).transpose()?;
    let parameters = parameters(args.config.as_deref())?;
    args.limits.apply_threads()?;
    interrupt::listen();
    let path = input.display().to_string();
    let (skeleton, skeleton_report) = read(&args.skeleton)?;
    let skeleton_time = milliseconds(started.elapsed());
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let limits = args.limits.after(started.elapsed());
    let mesh = meshed(&skeleton, &args.blocks, limits, &watch).with_context(|| path.clone())?;
    let mesh_time = milliseconds(started.elapsed()) - skeleton_time;
    wait.restart();
    let options = TransportOptions { limits: args.limits.after(started.elapsed()), progress: Some(&watch) };
    let found =
        transport(&mesh, &parameters, args.frames as usize, &options).with_context(|| path.clone())?;
    drop(wait);
    let transport_time = milliseconds(started.elapsed()) - skeleton_time - mesh_time;
    if let Some(series) = series {
        write_frames(series, &found.frames, printer, |frame| mesh.vtu_with(&frame.values))?;
    }
    if let Some(tips) = &args.tips {
        files::write_whole(tips, table(&mesh.caps, &parameters, &found).as_bytes(), printer)?;
    }
    let complete = found.stop == StopReason::Steps;
    if !complete {
        let done = found.report.steps;
        printer.warning(format_args!("stopped early by {} after {done} steps", stopped_by(found.stop)));
    }
    let timing = Timing {
        skeleton: skeleton_time,
        mesh: Some(mesh_time),
        transport: Some(transport_time),
        total: milliseconds(started.elapsed()),
        ..Timing::default()
    };
    let certified = mesh.report.certified;
    let report = NeuronReport {
        skeleton: skeleton_report,
        mesh: Some(mesh.report),
        spline: None,
        flow: None,
        transport: Some(found.report),
        timing,
    };
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
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
pub(super) fn write_frames(
    series: Series,
    frames: &[Frame],
    printer: &Printer,
    bytes: impl Fn(&Frame) -> std::io::Result<Vec<u8>>,
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
pub(super) fn table(caps: &[Cap], parameters: &Parameters, found: &Transport) -> String {
    let mut table = String::from("time,sample,free,plus,minus,total\n");
    for (step, ends) in found.ends.iter().enumerate() {
        let time = step as f64 * parameters.step;
        for (cap, [free, plus, minus]) in caps.iter().zip(ends) {
            let total = free + plus + minus;
            let _ = writeln!(table, "{time},{},{free},{plus},{minus},{total}", cap.sample);
        }
    }
    table
}
