//! Runs the stages with tricubic cells: splines, flow, and all of them after each other.

use super::args::{Everything, Flow as FlowArgs, Patches, SkeletonChoice, Spline as SplineArgs};
use super::run::check_output;
use super::source::Source;
use super::transport::{self, Moved, fingerprint, outputs, parameters, resumed};
use super::{extraction, json, text};
use crate::exit::Exit;
use crate::json::milliseconds;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{args::Limits, files, interrupt};
use anyhow::{Context, bail};
use pompeiu::core::run::{Progress, ProgressObserver};
use pompeiu::neuron::{
    CubicMesh, Flow, FlowCells, FlowOptions, FlowParameters, NeuronReport, NeuronSurface, Parameters,
    RefineAt, RefineOptions, Side, SplineReport, Timing, TransportOptions, neuron_flow, refined_splines,
    refined_vtu, transport_in_flow,
};
use pompeiu::volume::HierarchicalSplines;
use std::path::Path;
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
    fn new(choice: &SkeletonChoice, limits: &'r Limits, started: Instant) -> anyhow::Result<(Self, Source)> {
        limits.apply_threads()?;
        interrupt::listen();
        let path = choice.skeleton.display().to_string();
        let (source, skeleton) = Source::read(choice)?;
        let until = milliseconds(started.elapsed());
        let timing = Timing { skeleton: until, ..Timing::default() };
        let report = NeuronReport { skeleton, mesh: None, spline: None, flow: None, transport: None, timing };
        Ok((Self { started, path, limits, report, until }, source))
    }

    /// Milliseconds since the last stage ended.
    fn lap(&mut self) -> f64 {
        let now = milliseconds(self.started.elapsed());
        now - std::mem::replace(&mut self.until, now)
    }

    fn spline(
        &mut self,
        source: Source,
        layer: f64,
        sides: &[Side],
        elements: u8,
        watch: &dyn ProgressObserver,
    ) -> anyhow::Result<CubicMesh> {
        let limits = self.limits.after(self.started.elapsed());
        let mesh = source.patches(layer, sides, limits, watch).with_context(|| self.path.clone())?;
        self.report.timing.mesh = Some(self.lap());
        self.report.mesh = Some(mesh.report.clone());
        self.report.spline = Some(SplineReport::new(&mesh.mesh, elements.into()));
        self.report.timing.spline = Some(self.lap());
        Ok(mesh)
    }

    /// Refines splines.
    fn refine(
        &mut self,
        mesh: &CubicMesh,
        at: &[RefineAt],
        (elements, times): (u8, u8),
        watch: &dyn ProgressObserver,
    ) -> anyhow::Result<HierarchicalSplines> {
        let limits = self.limits.after(self.started.elapsed());
        let times = if at.is_empty() { 0 } else { times.into() };
        let options = RefineOptions { elements: elements.into(), at, times, limits, progress: Some(watch) };
        let splines = refined_splines(mesh, &options).with_context(|| self.path.clone())?;
        if !at.is_empty() {
            self.report.spline = Some(SplineReport::of_refined(&splines));
        }
        self.report.timing.spline = Some(self.report.timing.spline.unwrap_or(0.0) + self.lap());
        Ok(splines)
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

/// Meshes a skeleton with patches, and does what comes then.
fn patched<'r, B, T>(
    (choice, limits, patches, sides): (&SkeletonChoice, &'r Limits, &Patches, &[Side]),
    started: Instant,
    printer: &Printer,
    begin: impl FnOnce(&Source) -> anyhow::Result<B>,
    then: impl FnOnce(&mut Run<'r>, B, CubicMesh, &Wait, &dyn ProgressObserver) -> anyhow::Result<T>,
) -> anyhow::Result<(Run<'r>, T)> {
    let (mut run, source) = Run::new(choice, limits, started)?;
    let begun = begin(&source).with_context(|| run.path.clone())?;
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let mesh = run.spline(source, patches.layer, sides, patches.elements, &watch)?;
    let found = then(&mut run, begun, mesh, &wait, &watch)?;
    Ok((run, found))
}

/// Writes a file where one is named, answers, and ends.
fn finish(
    run: Run<'_>,
    (output, as_json): (Option<&Path>, bool),
    printer: &Printer,
    bytes: impl FnOnce() -> std::io::Result<Vec<u8>>,
) -> anyhow::Result<Exit> {
    if let Some(output) = output {
        files::write_whole(output, &bytes().with_context(|| output.display().to_string())?, printer)?;
    }
    Ok(if run.answer(as_json)? { Exit::Done } else { Exit::Undecided })
}

pub(super) fn spline(args: &SplineArgs, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let output = args.output.as_deref();
    check(output, args.json || args.extraction.is_some(), &args.skeleton.skeleton, "a mesh")?;
    let chosen = (&args.skeleton, &args.limits, &args.patches, [].as_slice());
    let places = |source: &Source| -> anyhow::Result<Vec<RefineAt>> {
        args.refine.iter().map(|name| Ok(RefineAt::from_name(name, source.skeleton())?)).collect()
    };
    let (run, (mesh, splines)) = patched(chosen, started, printer, places, |run, at, mesh, wait, watch| {
        if at.is_empty() && args.extraction.is_none() {
            return Ok((mesh, None));
        }
        wait.restart();
        let splines = run.refine(&mesh, &at, (args.patches.elements, args.levels), watch)?;
        Ok((mesh, Some(splines)))
    })?;
    if let Some((folder, splines)) = args.extraction.as_deref().zip(splines.as_ref()) {
        extraction::write_splines(folder, &mesh, splines, printer)?;
    }
    let refined = splines.filter(|_| !args.refine.is_empty());
    finish(run, (output, args.json), printer, || match &refined {
        Some(splines) => refined_vtu(&mesh, splines, args.patches.linear),
        None => mesh.vtu(args.patches.linear),
    })
}

pub(super) fn flow(args: &FlowArgs, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let output = args.output.as_deref();
    check(output, args.json, &args.skeleton.skeleton, "a flow")?;
    let parameters = parameters(args.config.as_deref())?;
    let chosen = (&args.skeleton, &args.limits, &args.patches, parameters.sides.as_slice());
    let (run, flow) = patched(
        chosen,
        started,
        printer,
        |_| Ok(()),
        |run, (), mesh, wait, watch| {
            wait.restart();
            run.flow(&mesh, &parameters.flow, args.patches.elements, watch)
        },
    )?;
    finish(run, (output, args.json), printer, || flow.vtu(args.patches.linear))
}

pub(super) fn run(args: &Everything, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let asked = &args.transport;
    let (_, series) = outputs(asked)?;
    let parameters: Parameters = parameters(asked.config.as_deref())?;
    let fingerprint = fingerprint(asked, &format!("all {}", args.elements))?;
    let resumed = resumed(asked, &fingerprint, &parameters)?;
    let (mut run, source) = Run::new(&asked.skeleton, &asked.limits, started)?;
    let wait = Wait::new(printer);
    let watch = |progress: &Progress<'_>| {
        wait.progress(progress);
        interrupt::flow()
    };
    let mesh = run.spline(source, asked.blocks.layer, &parameters.sides, args.elements, &watch)?;
    wait.restart();
    let flow = run.flow(&mesh, &parameters.flow, args.elements, &watch)?;
    wait.restart();
    let cells = FlowCells::new(&flow, asked.blocks.parts.into()).with_context(|| run.path.clone())?;
    let limits = asked.limits.after(started.elapsed());
    let options = TransportOptions { limits, progress: Some(&watch), resume: resumed.as_ref() };
    let found = transport_in_flow(&cells, &parameters, asked.frames as usize, &options)
        .with_context(|| run.path.clone())?;
    drop(wait);
    run.report.timing.transport = Some(run.lap());
    run.report.transport = Some(found.report.clone());
    let moved = Moved {
        caps: cells.caps(),
        inlet: found.inlet,
        surface: &|| NeuronSurface::of_flow(&cells),
        bytes: &|frame| cells.vtu(&frame.values, args.linear),
    };
    let settings = (started, parameters, fingerprint);
    transport::finish(asked, series, settings, &moved, found, run.report, printer)
}
