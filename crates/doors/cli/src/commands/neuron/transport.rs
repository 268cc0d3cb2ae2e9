//! Runs the stage of transport, and the whole.

use super::args::Transport as Args;
use super::run::{check_output, meshed, read};
use super::{json, text};
use crate::exit::{Exit, stopped_by};
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Progress, StopReason};
use pompeiu::neuron::{
    Frame, NeuronMesh, NeuronReport, Parameters, Timing, Transport, TransportOptions, read_transport_config,
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
    if let Some(output) = &args.output {
        check_output(output, input, "pvd", "a collection")?;
    }
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
    if let Some(output) = &args.output {
        write_frames(output, &mesh, &found.frames, printer)?;
    }
    if let Some(tips) = &args.tips {
        files::write_whole(tips, table(&mesh, &parameters, &found).as_bytes(), printer)?;
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
    };
    let certified = mesh.report.certified;
    let report = NeuronReport {
        skeleton: skeleton_report,
        mesh: Some(mesh.report),
        transport: Some(found.report),
        timing,
    };
    Printer::answer(&if args.json { json::json(&report)? } else { text::text(&path, &report) })?;
    Ok(if certified && complete { Exit::Done } else { Exit::Undecided })
}

fn parameters(config: Option<&Path>) -> anyhow::Result<Parameters> {
    let Some(config) = config else { return Ok(Parameters::default()) };
    files::check_readable(config)?;
    let shown = || config.display().to_string();
    let text = std::fs::read_to_string(config).with_context(shown)?;
    read_transport_config(&text).with_context(shown)
}

/// Writes a grid for each frame, then the collection that names them.
fn write_frames(output: &Path, mesh: &NeuronMesh, frames: &[Frame], printer: &Printer) -> anyhow::Result<()> {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let mut collection = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (index, frame) in frames.iter().enumerate() {
        let name = format!("{stem}_{index:04}.vtu");
        let path = output.with_file_name(&name);
        let bytes = mesh.vtu_with(&frame.values).with_context(|| path.display().to_string())?;
        pompeiu::io::write_whole(&path, &bytes)?;
        let escaped = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let _ = writeln!(collection, "<DataSet timestep=\"{}\" part=\"0\" file=\"{escaped}\"/>", frame.time);
    }
    collection.push_str("</Collection>\n</VTKFile>\n");
    files::write_whole(output, collection.as_bytes(), printer)
}

/// Concentrations at the flat ends after each step.
fn table(mesh: &NeuronMesh, parameters: &Parameters, found: &Transport) -> String {
    let mut table = String::from("time,sample,free,plus,minus,total\n");
    for (step, ends) in found.ends.iter().enumerate() {
        let time = step as f64 * parameters.step;
        for (cap, [free, plus, minus]) in mesh.caps.iter().zip(ends) {
            let total = free + plus + minus;
            let _ = writeln!(table, "{time},{},{free},{plus},{minus},{total}", cap.sample);
        }
    }
    table
}
