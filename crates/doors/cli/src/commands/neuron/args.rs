//! Files of the neuron command.

use crate::args::suffix;
use anyhow::bail;
use clap::{Args, ValueEnum};
use pompeiu::neuron::Stage;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_long_help = include_str!("help.txt"), after_help = "\
Skeletons are SWC files, in micrometres: comments, ids in any order, several trees, a soma of one, three or many samples, any line
ends. Without the name of a stage all of them follow each other: the skeleton is checked and filled with tricubic cells, the flow through
them is solved for, and material is transported along it. The output is a collection (.pvd) of grids in a folder
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
    pub(super) named: Vec<PathBuf>,
    /// The file to write: .swc of check, .vtu of mesh, spline and flow, .pvd of transport and of all stages, with a grid for each frame
    /// beside it
    #[arg(long, short, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Write tricubic cells exactly, as Bezier hexahedra, instead of 27 trilinear cells for each, which other programs read, too
    #[arg(long)]
    pub(super) bezier: bool,
    /// Stages mesh and spline: write bzmeshinfo.txt, bzpt.txt, cmat.txt, and of a mesh controlmesh.vtk into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(super) extraction: Option<PathBuf>,
    /// Stage mesh: compare with bzmeshinfo.txt, bzpt.txt and cmat.txt in this folder, those there are
    #[arg(long, value_name = "FOLDER")]
    pub(super) compare: Option<PathBuf>,
    /// Stage mesh: deal the cells out to N processes, in a file .epart.N beside OUT or beside bzmeshinfo.txt
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=1_000_000), value_name = "N")]
    pub(super) partition: Option<u32>,
    /// Transport: concentrations at the flat ends after each step, as CSV
    #[arg(long = "tips", value_name = "OUT")]
    pub(super) tips_table: Option<PathBuf>,
    /// Transport: write a page that plays it, with concentrations at the ends over time: one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    pub(super) report: Option<PathBuf>,
    /// Transport: write the state in the end, however it ended
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
}

impl Files {
    /// The file comes last.
    pub(super) fn skeleton(&self) -> &Path {
        self.named.last().map_or(Path::new(""), PathBuf::as_path)
    }

    /// The stage before the file, or else that of the options.
    pub(super) fn stage(&self, asked: Stage) -> anyhow::Result<Stage> {
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
