//! Runs the command.

use super::args::{Check, Mesh, Neuron as Args, Stage};
use super::source::{Source, is_mesh, skeleton};
use super::{everything, extraction, json, text, transport};
use crate::exit::Exit;
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::Progress;
use pompeiu::neuron::{FlowError, MeshError, NeuronReport, Timing, write_swc};
use std::ffi::OsStr;
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let done = match (&args.stage, &args.whole.0) {
        (Some(Stage::Check(args)), _) => check(args, printer),
        (Some(Stage::Mesh(args)), _) => mesh(args, printer),
        (Some(Stage::Spline(args)), _) => everything::spline(args, printer),
        (Some(Stage::Flow(args)), _) => everything::flow(args, printer),
        (Some(Stage::Transport(args)), _) => transport::run(args, printer),
        (None, Some(args)) => everything::run(args, printer),
        (None, None) => {
            bail!("name a skeleton file (.swc), or a stage: check, mesh, spline, flow or transport")
        }
    };
    done.or_else(|error| {
        let of_mesh = matches!(error.downcast_ref(), Some(MeshError::Stopped(_)));
        if !of_mesh && !matches!(error.downcast_ref(), Some(FlowError::Stopped(_))) {
            return Err(error);
        }
        Printer::error(&error);
        Ok(Exit::Undecided)
    })
}

fn check(args: &Check, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if let Some(output) = &args.output {
        check_output(output, &args.skeleton.skeleton, "swc", "a skeleton")?;
    }
    if is_mesh(&args.skeleton.skeleton) {
        bail!("{}: is a mesh; `pompeiu neuron mesh` checks it", args.skeleton.skeleton.display());
    }
    let (skeleton, report) = skeleton(&args.skeleton)?;
    let has_problems = !report.problems.is_empty();
    let skeleton_time = milliseconds(started.elapsed());
    if let Some(output) = &args.output {
        files::write_whole(output, write_swc(&skeleton.rows()).as_bytes(), printer)?;
    }
    let timing =
        Timing { skeleton: skeleton_time, total: milliseconds(started.elapsed()), ..Timing::default() };
    let report = NeuronReport {
        skeleton: Some(report),
        mesh: None,
        spline: None,
        flow: None,
        transport: None,
        timing,
    };
    let path = args.skeleton.skeleton.display().to_string();
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    Ok(if has_problems { Exit::Above } else { Exit::Done })
}

fn mesh(args: &Mesh, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let folders = || args.extraction.iter().chain(&args.compare);
    if args.output.is_none() && folders().next().is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --json");
    }
    let beside = match (&args.output, &args.extraction) {
        (_, Some(folder)) => Some(folder.join("bzmeshinfo.txt")),
        (output, None) => output.clone(),
    };
    if args.partition.is_some() && beside.is_none() {
        bail!("a partition is written beside a mesh: name one with -o, or a folder with --extraction");
    }
    if let Some(output) = &args.output {
        check_output(output, &args.skeleton.skeleton, "vtu", "a mesh")?;
    }
    args.limits.apply_threads()?;
    interrupt::listen();
    let path = args.skeleton.skeleton.display().to_string();
    let (source, skeleton) = Source::read(&args.skeleton)?;
    let skeleton_time = milliseconds(started.elapsed());
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let limits = args.limits.after(started.elapsed());
    let mesh = source.hexahedra(&args.blocks, &[], limits, &watch).with_context(|| path.clone())?;
    drop(wait);
    let mesh_time = milliseconds(started.elapsed()) - skeleton_time;
    if let Some(output) = &args.output {
        files::write_whole(output, &mesh.vtu().with_context(|| output.display().to_string())?, printer)?;
    }
    if let Some(folder) = &args.extraction {
        extraction::write(folder, &mesh, printer)?;
    }
    if let Some((parts, beside)) = args.partition.zip(beside) {
        extraction::write_partition(&beside, &mesh, parts as usize, printer)?;
    }
    let agrees = match &args.compare {
        Some(folder) => extraction::compare(folder, &mesh, printer)?,
        None => true,
    };
    let timing = Timing {
        skeleton: skeleton_time,
        mesh: Some(mesh_time),
        total: milliseconds(started.elapsed()),
        ..Timing::default()
    };
    let certified = mesh.report.certified;
    let report =
        NeuronReport { skeleton, mesh: Some(mesh.report), spline: None, flow: None, transport: None, timing };
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    Ok(match (certified, agrees) {
        (false, _) => Exit::Undecided,
        (true, false) => Exit::Above,
        (true, true) => Exit::Done,
    })
}

pub(super) fn check_output(output: &Path, input: &Path, suffix: &str, what: &str) -> anyhow::Result<()> {
    files::check_places([output], &[input])?;
    if output.extension().map(OsStr::to_ascii_lowercase).as_deref() != Some(OsStr::new(suffix)) {
        bail!("{}: {what} is written as .{suffix}", output.display());
    }
    Ok(())
}
