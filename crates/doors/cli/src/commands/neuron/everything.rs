//! Runs the stages with tricubic cells: splines, flow, and all of them after each other.

use super::args::{Everything, Flow as FlowArgs, Patches, SkeletonChoice, Spline as SplineArgs};
use super::run::{check_output, read};
use super::transport::{parameters, table, write_frames};
use super::{json, text};
use crate::exit::{Exit, stopped_by};
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::series::Series;
use crate::wait::Wait;
use crate::{args::Limits, files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Progress, ProgressObserver, StopReason};
use pompeiu::neuron::{
    CubicMesh, Flow, FlowCells, FlowOptions, FlowParameters, MeshOptions, NeuronReport, Parameters, Skeleton,
    SplineReport, Timing, TransportOptions, cubic_neuron, neuron_flow, transport_in_flow,
};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The stages so far.
struct Run<'r> {
    started: Instant,
    path: String,
    limits: &'r Limits,
    report: NeuronReport,
    /// Milliseconds until the last stage ended.
    until: f64,
}

impl<'r> Run<'r> {
    /// Reads the skeleton.
    fn new(
        choice: &SkeletonChoice,
        limits: &'r Limits,
        started: Instant,
    ) -> anyhow::Result<(Self, Skeleton)> {
        limits.apply_threads()?;
        interrupt::listen();
        let path = choice.skeleton.display().to_string();
        let (skeleton, report) = read(choice)?;
        let until = milliseconds(started.elapsed());
        let timing = Timing { skeleton: until, ..Timing::default() };
        let report =
            NeuronReport { skeleton: report, mesh: None, spline: None, flow: None, transport: None, timing };
        Ok((Self { started, path, limits, report, until }, skeleton))
    }

    /// Milliseconds since the last stage ended.
    fn lap(&mut self) -> f64 {
        let now = milliseconds(self.started.elapsed());
        now - std::mem::replace(&mut self.until, now)
    }

    fn spline(
        &mut self,
        skeleton: &Skeleton,
        layer: f64,
        elements: u8,
        watch: &dyn ProgressObserver,
    ) -> anyhow::Result<CubicMesh> {
        let limits = self.limits.after(self.started.elapsed());
        let options = MeshOptions { layer, limits, progress: Some(watch), ..MeshOptions::default() };
        let mesh = cubic_neuron(skeleton, &options).with_context(|| self.path.clone())?;
        self.report.timing.mesh = Some(self.lap());
        self.report.mesh = Some(mesh.report.clone());
        self.report.spline = Some(SplineReport::new(&mesh.mesh, elements.into()));
        self.report.timing.spline = Some(self.lap());
        Ok(mesh)
    }

    fn flow(
        &mut self,
        mesh: &CubicMesh,
        parameters: &FlowParameters,
        elements: u8,
        watch: &dyn ProgressObserver,
    ) -> anyhow::Result<Flow> {
        let limits = self.limits.after(self.started.elapsed());
        let options = FlowOptions { elements: elements.into(), limits, progress: Some(watch) };
        let flow = neuron_flow(mesh, parameters, &options).with_context(|| self.path.clone())?;
        self.report.timing.flow = Some(self.lap());
        self.report.flow = Some(flow.report.clone());
        Ok(flow)
    }

    /// Answers; gives whether every cell is proven valid.
    fn answer(mut self, as_json: bool) -> anyhow::Result<bool> {
        self.report.timing.total = milliseconds(self.started.elapsed());
        let text = if as_json { json::json(&self.report)? } else { text::text(&self.path, &self.report) };
        Printer::answer(&text)?;
        Ok(self.report.mesh.is_none_or(|mesh| mesh.certified))
    }
}

fn check(output: Option<&Path>, as_json: bool, skeleton: &Path, what: &str) -> anyhow::Result<()> {
    match output {
        None if !as_json => bail!("nothing would be written; name the result with -o, or ask for --json"),
        None => Ok(()),
        Some(output) => check_output(output, skeleton, "vtu", what),
    }
}

pub(super) fn spline(args: &SplineArgs, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    check(args.output.as_deref(), args.json, &args.skeleton.skeleton, "a mesh")?;
    let (mut run, skeleton) = Run::new(&args.skeleton, &args.limits, started)?;
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let Patches { elements, layer, linear } = args.patches;
    let mesh = run.spline(&skeleton, layer, elements, &watch)?;
    drop(wait);
    if let Some(output) = &args.output {
        let bytes = mesh.vtu(linear).with_context(|| output.display().to_string())?;
        files::write_whole(output, &bytes, printer)?;
    }
    Ok(if run.answer(args.json)? { Exit::Done } else { Exit::Undecided })
}

pub(super) fn flow(args: &FlowArgs, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    check(args.output.as_deref(), args.json, &args.skeleton.skeleton, "a flow")?;
    let parameters = parameters(args.config.as_deref())?;
    let (mut run, skeleton) = Run::new(&args.skeleton, &args.limits, started)?;
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let Patches { elements, layer, linear } = args.patches;
    let mesh = run.spline(&skeleton, layer, elements, &watch)?;
    wait.restart();
    let flow = run.flow(&mesh, &parameters.flow, elements, &watch)?;
    drop(wait);
    if let Some(output) = &args.output {
        let bytes = flow.vtu(linear).with_context(|| output.display().to_string())?;
        files::write_whole(output, &bytes, printer)?;
    }
    Ok(if run.answer(args.json)? { Exit::Done } else { Exit::Undecided })
}

pub(super) fn run(args: &Everything, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let asked = &args.transport;
    if asked.output.is_none() && asked.tips.is_none() && !asked.json {
        bail!("nothing would be written; name the result with -o, or ask for --tips or --json");
    }
    let input = asked.skeleton.skeleton.as_path();
    files::check_places(asked.output.iter().chain(&asked.tips).map(PathBuf::as_path), &[input])?;
    let series = asked.output.as_deref().map(|list| Series::of(list, "vtu")).transpose()?;
    let parameters: Parameters = parameters(asked.config.as_deref())?;
    let (mut run, skeleton) = Run::new(&asked.skeleton, &asked.limits, started)?;
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let mesh = run.spline(&skeleton, asked.blocks.layer, args.elements, &watch)?;
    wait.restart();
    let flow = run.flow(&mesh, &parameters.flow, args.elements, &watch)?;
    wait.restart();
    let cells = FlowCells::new(&flow, asked.blocks.parts.into()).with_context(|| run.path.clone())?;
    let options = TransportOptions { limits: asked.limits.after(started.elapsed()), progress: Some(&watch) };
    let found = transport_in_flow(&cells, &parameters, asked.frames as usize, &options)
        .with_context(|| run.path.clone())?;
    drop(wait);
    run.report.timing.transport = Some(run.lap());
    if let Some(series) = series {
        write_frames(series, &found.frames, printer, |frame| cells.vtu(&frame.values, args.linear))?;
    }
    if let Some(tips) = &asked.tips {
        files::write_whole(tips, table(cells.caps(), &parameters, &found).as_bytes(), printer)?;
    }
    let complete = found.stop == StopReason::Steps;
    if !complete {
        let done = found.report.steps;
        printer.warning(format_args!("stopped early by {} after {done} steps", stopped_by(found.stop)));
    }
    run.report.transport = Some(found.report);
    let certified = run.answer(asked.json)?;
    Ok(if certified && complete { Exit::Done } else { Exit::Undecided })
}
