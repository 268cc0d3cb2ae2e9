//! `pompeiu neuron`.

mod extraction;
mod output;
mod text;

use crate::args::suffix;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use anyhow::{Context, bail};
use clap::{Args, ValueEnum};
use output::Outputs;
use pompeiu::neuron::{NeuronReport, NeuronRequest, NeuronRequestError, NeuronSource, Stage};
use pompeiu::options::{Options, OptionsError, options_of_toml};
use pompeiu::volume::HexMesh;
use std::path::{Path, PathBuf};

pub(crate) use crate::door::run;

pub(crate) type Neuron = Invocation<Files>;

#[derive(Args)]
#[command(after_long_help = include_str!("help.txt"), after_help = "\
Skeletons are SWC files, in micrometres: comments, ids in any order, several trees, a soma of one, three or many samples, any line
ends. Without the name of a stage all of them follow each other: the skeleton is checked and filled with tricubic cells, the flow through
them is solved for, and material is transported along it. The output is a collection (.pvd) of grids of Bezier hexahedra in a folder
beside it. --help says more of the stages, and of the tables of parameters in --config.

Examples:
  pompeiu neuron cell.swc --config run.toml -o run.pvd --report run.html
  pompeiu neuron check cell.swc
  pompeiu neuron check cell.swc --repair --smooth 20 --spacing 0.5 -o smooth.swc
  pompeiu neuron mesh smooth.swc -o cell.vtu
  pompeiu neuron flow smooth.swc --config run.toml -o flow.vtu")]
pub(crate) struct Files {
    /// The skeleton file (SWC), or a hexahedral mesh (.vtk, .vtu); before it the name of a stage, to end there
    #[arg(value_name = "[STAGE] SKELETON", required = true, num_args = 1..=2)]
    named: Vec<PathBuf>,
    /// The file to write: .swc of check, .vtu of mesh, spline and flow, .pvd of transport and of all stages, with a grid for each frame
    /// beside it
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write trilinear cells, 27 for each tricubic one, instead of Bezier hexahedra
    #[arg(long)]
    linear: bool,
    /// Stages mesh and spline: write bzmeshinfo.txt, bzpt.txt, cmat.txt, and of a mesh controlmesh.vtk into this folder
    #[arg(long, value_name = "FOLDER")]
    extraction: Option<PathBuf>,
    /// Stage mesh: compare with bzmeshinfo.txt, bzpt.txt and cmat.txt in this folder, those there are
    #[arg(long, value_name = "FOLDER")]
    compare: Option<PathBuf>,
    /// Stage mesh: deal the cells out to N processes, in a file .epart.N beside OUT or beside bzmeshinfo.txt
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=1_000_000), value_name = "N")]
    partition: Option<u32>,
    /// Transport: concentrations at the flat ends after each step, as CSV
    #[arg(long = "tips", value_name = "OUT")]
    tips_table: Option<PathBuf>,
    /// Transport: write a page that plays it, with concentrations at the ends over time: one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Transport: write the state in the end, however it ended
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
}

impl System for Files {
    type Request = NeuronRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        Ok(())
    }

    /// A parameter file of `NeuronTransportIGA` is named by the option that takes it.
    fn options_in(path: &Path, text: &str) -> Result<Options, OptionsError> {
        let read = options_of_toml(text);
        if read.is_err() && is_pairs(text) {
            return Ok(Options::from_iter([("parameters".to_owned(), path.display().to_string().into())]));
        }
        read
    }

    fn run(&self, request: &mut NeuronRequest, session: &mut Session<'_>) -> anyhow::Result<NeuronReport> {
        let skeleton = self.skeleton();
        request.stage = self.stage(request.stage)?;
        let outputs = Outputs::of(self, request, session.is_json())?;
        let shown = || skeleton.display().to_string();
        session.wait.show(format!("reading {}", shown()));
        let source = source(skeleton)?;
        let found = request.run(source, self.extraction.is_some(), &session.context());
        let mut found = found.map_err(|error| match &error {
            NeuronRequestError::File { .. }
            | NeuronRequestError::Parameters { .. }
            | NeuronRequestError::Checkpoint { .. }
            | NeuronRequestError::Table(_) => anyhow::Error::new(error),
            _ => anyhow::Error::new(error).context(shown()),
        })?;
        session.stop_waiting();
        session.note_points(skeleton, found.points);
        outputs.write(&mut found, session.printer)?;
        if let Some(ended) = &found.report.ended {
            session.printer.warning(format_args!("{}: {ended}", shown()));
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.skeleton().display().to_string(), answer)
    }
}

impl Files {
    /// The file comes last.
    fn skeleton(&self) -> &Path {
        self.named.last().map_or(Path::new(""), PathBuf::as_path)
    }

    /// The stage before the file, or else that of the options.
    fn stage(&self, asked: Stage) -> anyhow::Result<Stage> {
        let named = match &self.named[..] {
            [_] => return Ok(asked),
            [named, _] => named,
            files => bail!("{} files are named; work on one, with the stage before it", files.len()),
        };
        let name = named.to_string_lossy();
        let Ok(stage) = Stage::from_str(&name, false) else {
            bail!(
                "there is no stage `{name}`; choose check, mesh, spline, flow, transport or all, before one file"
            )
        };
        if asked != Stage::default() && asked != stage {
            bail!("two stages are named, one of them by --stage or in a file; leave out one of them");
        }
        Ok(stage)
    }
}

/// Whether a text begins with a name and a value, without a sign of TOML.
fn is_pairs(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| {
        !line.starts_with('[') && !line.contains('=') && line.split_whitespace().count() == 2
    })
}

/// Reads a skeleton, or a mesh.
fn source(path: &Path) -> anyhow::Result<NeuronSource> {
    let shown = || path.display().to_string();
    files::check_readable(path)?;
    let content = std::fs::read(path).with_context(shown)?;
    if !is_mesh(path) {
        return Ok(NeuronSource::skeleton(content));
    }
    let read = pompeiu::io::read_hexahedra(path)?;
    let positions = read.positions.into_iter().map(Into::into).collect();
    Ok(NeuronSource::mesh(content, HexMesh::new(positions, read.cells).with_context(shown)?, read.labels))
}

/// Whether a file is a mesh by its name.
fn is_mesh(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    [".vtk", ".vtu"].iter().any(|suffix| name.ends_with(suffix))
}
