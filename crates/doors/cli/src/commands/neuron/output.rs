//! The files that the stages leave.

use super::args::Files;
use super::extraction;
use crate::called::called;
use crate::files;
use crate::printer::Printer;
use crate::series::Series;
use anyhow::{Context, bail};
use pompeiu::neuron::{
    LinearShares, NeuronAnswer, NeuronPage, NeuronReport, NeuronRequest, Stage, Transported, refined_vtu,
    write_swc,
};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The files to write, which suit the stage.
pub(super) struct Outputs<'f> {
    files: &'f Files,
    series: Option<Series>,
    /// What a partition is written beside.
    beside: Option<PathBuf>,
    is_refined: bool,
}

impl<'f> Outputs<'f> {
    /// Refuses, before anything is read, files that do not suit the stage or cannot be written, and a run that would leave nothing.
    pub(super) fn of(files: &'f Files, request: &NeuronRequest, is_json: bool) -> anyhow::Result<Self> {
        let stage = request.stage;
        let of_stages = [
            ("--bezier", files.bezier, matches!(stage, Stage::Spline | Stage::Flow | Stage::All)),
            ("--extraction", files.extraction.is_some(), matches!(stage, Stage::Mesh | Stage::Spline)),
            ("--compare", files.compare.is_some(), stage == Stage::Mesh),
            ("--partition", files.partition.is_some(), stage == Stage::Mesh),
            ("--tips", files.tips_table.is_some(), stage.carries()),
            ("--report", files.report.is_some(), stage.carries()),
            ("--checkpoint", files.checkpoint.is_some(), stage.carries()),
        ];
        if let Some((option, ..)) = of_stages.iter().find(|(_, is_given, is_used)| *is_given && !is_used) {
            bail!("{option} is not for this stage; leave it out, or name another stage");
        }
        let written =
            || [&files.output, &files.tips_table, &files.report, &files.checkpoint].into_iter().flatten();
        let folders = files.extraction.iter().chain(&files.compare);
        if written().chain(folders).next().is_none() && !is_json && stage != Stage::Check {
            let kinds = if stage.carries() { "--report, --tips or --json" } else { "--json" };
            bail!("nothing would be written; name the result with -o, or ask for {kinds}");
        }
        // A checkpoint may be written over the one that it began from.
        let inputs: Vec<&Path> =
            std::iter::once(files.skeleton()).chain(request.parameters.as_deref()).collect();
        files::check_places(written().map(PathBuf::as_path), &inputs)?;
        let beside = match (&files.output, &files.extraction) {
            (_, Some(folder)) => Some(folder.join("bzmeshinfo.txt")),
            (output, None) => output.clone(),
        };
        if files.partition.is_some() && beside.is_none() {
            bail!("a partition is written beside a mesh: name one with -o, or a folder with --extraction");
        }
        let (suffix, what) = match stage {
            Stage::Check => ("swc", "a skeleton"),
            Stage::Flow => ("vtu", "a flow"),
            _ => ("vtu", "a mesh"),
        };
        let mut series = None;
        match files.output.as_deref() {
            Some(list) if stage.carries() => series = Some(Series::of(list, "vtu")?),
            Some(output) if !output.extension().is_some_and(|found| found.eq_ignore_ascii_case(suffix)) => {
                bail!("{}: {what} is written as .{suffix}", output.display())
            }
            _ => {}
        }
        Ok(Self { files, series, beside, is_refined: !request.refine.is_empty() })
    }

    pub(super) fn write(self, found: &mut NeuronAnswer, printer: &Printer) -> anyhow::Result<()> {
        if let (Some(output), None) = (&self.files.output, &self.series) {
            self.single(output, found, printer)?;
        }
        self.mesh(found, printer)?;
        if let (Some(folder), Some(mesh), Some(splines)) =
            (&self.files.extraction, &found.patches, &found.splines)
        {
            extraction::write_splines(folder, mesh, splines, printer)?;
        }
        let Some(run) = &found.transported else { return Ok(()) };
        let Self { files, series, .. } = self;
        if let Some(series) = series {
            frames(series, run, !files.bezier, printer)?;
            if let (Some(list), false, Some(linear)) = (&files.output, files.bezier, run.found.report.linear)
            {
                note_loss(list, linear, printer);
            }
        }
        if let Some(tips) = &files.tips_table {
            files::write_whole(tips, table(run).as_bytes(), printer)?;
        }
        if let Some(place) = &files.report {
            files::write_whole(place, page(files, run, &found.report)?.as_bytes(), printer)?;
        }
        if let Some(place) = &files.checkpoint {
            files::write_whole(place, &run.checkpoint().to_bytes()?, printer)?;
        }
        Ok(())
    }

    /// The file of a stage before transport; none if a limit ended that stage.
    fn single(&self, output: &Path, found: &NeuronAnswer, printer: &Printer) -> anyhow::Result<()> {
        let linear = !self.files.bezier;
        let bytes = match found {
            NeuronAnswer { flow: Some(flow), .. } => Some(flow.vtu(linear)),
            NeuronAnswer { patches: Some(mesh), splines: Some(splines), .. } if self.is_refined => {
                Some(refined_vtu(mesh, splines, linear))
            }
            NeuronAnswer { patches: Some(mesh), .. } => Some(mesh.vtu(linear)),
            NeuronAnswer { hexahedra: Some(mesh), .. } => Some(mesh.vtu()),
            NeuronAnswer { skeleton: Some(skeleton), report, .. } if report.is_check => {
                Some(Ok(write_swc(&skeleton.rows()).into_bytes()))
            }
            _ => None,
        };
        let Some(bytes) = bytes else { return Ok(()) };
        let share = match found {
            NeuronAnswer { flow: Some(flow), .. } => Some(flow.report.linear),
            NeuronAnswer { patches: Some(mesh), .. } => mesh.report.linear,
            _ => None,
        };
        if let Some(share) = share.filter(|_| linear) {
            note_loss(output, share, printer);
        }
        files::write_whole(output, &bytes.with_context(|| output.display().to_string())?, printer)
    }

    /// What belongs to trilinear cells.
    fn mesh(&self, found: &mut NeuronAnswer, printer: &Printer) -> anyhow::Result<()> {
        let Some(mesh) = &found.hexahedra else { return Ok(()) };
        if let Some(folder) = &self.files.extraction {
            extraction::write(folder, mesh, printer)?;
        }
        if let Some((parts, beside)) = self.files.partition.zip(self.beside.as_deref()) {
            extraction::write_partition(beside, mesh, parts as usize, printer)?;
        }
        if let Some(folder) = &self.files.compare {
            found.report.agrees = Some(extraction::compare(folder, mesh, printer)?);
        }
        Ok(())
    }
}

/// Says what trilinear cells lose of curved ones.
fn note_loss(output: &Path, linear: LinearShares, printer: &Printer) {
    let percent = |share: f64, of: &str| format!("{:.1} % of the {of}", 100.0 * share);
    let shares = [
        Some(percent(linear.volume, "volume")),
        linear.area.map(|share| percent(share, "area of the ends")),
        linear.flux.map(|share| percent(share, "flux at the inlet")),
    ];
    printer.note(format_args!(
        "{}: trilinear cells, which have {}; --bezier writes tricubic cells exactly",
        output.display(),
        shares.into_iter().flatten().collect::<Vec<_>>().join(", ")
    ));
}

/// Writes a grid for each frame, and the collection that names them.
fn frames(series: Series, run: &Transported, linear: bool, printer: &Printer) -> anyhow::Result<()> {
    for frame in &run.found.state.frames {
        let write = |path: &Path| {
            let bytes = run.cells.vtu(frame, linear).with_context(|| path.display().to_string())?;
            Ok(pompeiu::io::write_whole(path, &bytes)?)
        };
        if series.add(frame.step, frame.time, write).is_break() {
            break;
        }
    }
    series.finish(printer)
}

fn page(files: &Files, run: &Transported, report: &NeuronReport) -> anyhow::Result<String> {
    let page = NeuronPage {
        path: &files.skeleton().display().to_string(),
        surface: &run.cells.surface(),
        caps: run.cells.caps(),
        inlet: run.found.inlet,
        parameters: &run.parameters,
        state: &run.found.state,
        report,
        command: Some(&called()),
    };
    Ok(page.html()?)
}

/// Concentrations at the flat ends after each step.
fn table(run: &Transported) -> String {
    let mut table = String::from("time,sample,free,plus,minus,total\n");
    for (step, ends) in run.found.state.ends.iter().enumerate() {
        let time = step as f64 * run.parameters.step;
        for (cap, [free, plus, minus]) in run.cells.caps().iter().zip(ends) {
            let total = free + plus + minus;
            let _ = writeln!(table, "{time},{},{free},{plus},{minus},{total}", cap.sample);
        }
    }
    table
}
