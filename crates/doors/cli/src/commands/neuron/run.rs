//! Runs the command.

use super::args::{Blocks, Check, Mesh, Neuron as Args, SkeletonChoice, Stage};
use super::{everything, json, text, transport};
use crate::exit::Exit;
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Limits, Progress, ProgressObserver};
use pompeiu::neuron::{
    MeshError, MeshOptions, NeuronMesh, NeuronReport, Preparation, Skeleton, SkeletonReport, SmoothOptions,
    Timing, mesh_neuron, prepare, write_swc,
};
use std::ffi::OsStr;
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    match (&args.stage, &args.whole.0) {
        (Some(Stage::Check(args)), _) => check(args, printer),
        (Some(Stage::Mesh(args)), _) => mesh(args, printer),
        (Some(Stage::Spline(args)), _) => everything::spline(args, printer),
        (Some(Stage::Flow(args)), _) => everything::flow(args, printer),
        (Some(Stage::Transport(args)), _) => transport::run(args, printer),
        (None, Some(args)) => everything::run(args, printer),
        (None, None) => {
            bail!("name a skeleton file (.swc), or a stage: check, mesh, spline, flow or transport")
        }
    }
}

fn check(args: &Check, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if let Some(output) = &args.output {
        check_output(output, &args.skeleton.skeleton, "swc", "a skeleton")?;
    }
    let (skeleton, report) = read(&args.skeleton)?;
    let skeleton_time = milliseconds(started.elapsed());
    if let Some(output) = &args.output {
        files::write_whole(output, write_swc(&skeleton.rows()).as_bytes(), printer)?;
    }
    let timing =
        Timing { skeleton: skeleton_time, total: milliseconds(started.elapsed()), ..Timing::default() };
    let report =
        NeuronReport { skeleton: report, mesh: None, spline: None, flow: None, transport: None, timing };
    let path = args.skeleton.skeleton.display().to_string();
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    Ok(if report.skeleton.problems.is_empty() { Exit::Done } else { Exit::Above })
}

fn mesh(args: &Mesh, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --json");
    }
    if let Some(output) = &args.output {
        check_output(output, &args.skeleton.skeleton, "vtu", "a mesh")?;
    }
    args.limits.apply_threads()?;
    interrupt::listen();
    let path = args.skeleton.skeleton.display().to_string();
    let (skeleton, skeleton_report) = read(&args.skeleton)?;
    let skeleton_time = milliseconds(started.elapsed());
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let limits = args.limits.after(started.elapsed());
    let mesh = meshed(&skeleton, &args.blocks, limits, &watch).with_context(|| path.clone())?;
    drop(wait);
    let mesh_time = milliseconds(started.elapsed()) - skeleton_time;
    if let Some(output) = &args.output {
        files::write_whole(output, &mesh.vtu().with_context(|| output.display().to_string())?, printer)?;
    }
    let timing = Timing {
        skeleton: skeleton_time,
        mesh: Some(mesh_time),
        total: milliseconds(started.elapsed()),
        ..Timing::default()
    };
    let certified = mesh.report.certified;
    let report = NeuronReport {
        skeleton: skeleton_report,
        mesh: Some(mesh.report),
        spline: None,
        flow: None,
        transport: None,
        timing,
    };
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    Ok(if certified { Exit::Done } else { Exit::Undecided })
}

/// Fills a skeleton with hexahedra as asked.
pub(super) fn meshed(
    skeleton: &Skeleton,
    blocks: &Blocks,
    limits: Limits,
    progress: &dyn ProgressObserver,
) -> Result<NeuronMesh, MeshError> {
    let options = MeshOptions {
        parts: blocks.parts.into(),
        layer: blocks.layer,
        limits,
        progress: Some(progress),
        ..MeshOptions::default()
    };
    mesh_neuron(skeleton, &options)
}

pub(super) fn check_output(output: &Path, input: &Path, suffix: &str, what: &str) -> anyhow::Result<()> {
    files::check_places([output], &[input])?;
    if output.extension().map(OsStr::to_ascii_lowercase).as_deref() != Some(OsStr::new(suffix)) {
        bail!("{}: {what} is written as .{suffix}", output.display());
    }
    Ok(())
}

/// Reads a skeleton and does what is asked to it.
pub(super) fn read(choice: &SkeletonChoice) -> anyhow::Result<(Skeleton, SkeletonReport)> {
    let shown = || choice.skeleton.display().to_string();
    files::check_readable(&choice.skeleton)?;
    let bytes = std::fs::read(&choice.skeleton).with_context(shown)?;
    let smooth = SmoothOptions { steps: choice.smooth as usize, spacing: choice.spacing };
    prepare(&bytes, &Preparation { repair: choice.repair, smooth }).with_context(shown)
}
