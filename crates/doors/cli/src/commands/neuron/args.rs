//! Options of the neuron command.

use crate::args::Limits;
use crate::numbers::magnitude;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Mesh a neuron from its skeleton, with every cell proven valid; or look for what is wrong with it
#[derive(Args)]
#[command(after_help = "\
Skeletons are SWC files, in micrometres: comments, ids in any order, several trees, a soma of one, three or many samples, any line
ends.

Examples:
  pompeiu neuron check cell.swc
  pompeiu neuron check cell.swc --repair --smooth 20 --spacing 0.5 -o smooth.swc
  pompeiu neuron mesh smooth.swc -o cell.vtu")]
pub(crate) struct Neuron {
    #[command(subcommand)]
    pub(crate) stage: Stage,
}

#[derive(Subcommand)]
#[command(subcommand_value_name = "STAGE", subcommand_help_heading = "Stages")]
pub(crate) enum Stage {
    /// Look at the skeleton, and say what is wrong with it and where
    #[command(after_help = "\
The exit code is 1 if there are problems: several trees, samples without a radius or at the place of their parent, branches within
the balls of their nodes, branches inside others, tubes that overlap, turns by more than 60 degrees within a radius.

Examples:
  pompeiu neuron check cell.swc --json
  pompeiu neuron check cell.swc --repair -o repaired.swc")]
    Check(Check),
    /// Fill the neuron with hexahedra
    #[command(after_help = "\
Sections are discs of five blocks, each cut into parts; around nodes there are complexes that suit their degree, and the wall is a
smooth union of the tubes. Tips, and roots with one branch, end with flat caps. Sections keep the area of the discs. The exit code is
3 if a cell is not proven valid.

The output has cell data: branch (from 0; -1, -2, ... at nodes).

Examples:
  pompeiu neuron mesh cell.swc -o cell.vtu
  pompeiu neuron mesh cell.swc --repair --parts 3 --layer 1 --json -o fine.vtu")]
    Mesh(Mesh),
}

#[derive(Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    /// The skeleton file to write (.swc), after repair, smoothing and resampling
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct Mesh {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    /// Parts of each block along each edge: 1, 2 and 3 give 5, 20 and 45 cells to a section
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=8), value_name = "N")]
    pub(crate) parts: u8,
    /// Length of a block along a branch, in radii
    #[arg(long, default_value = "2", value_parser = magnitude, value_name = "RADII")]
    pub(crate) layer: f64,
    /// The mesh file to write (.vtu)
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// The skeleton, and what is done to it before anything else.
#[derive(Args)]
pub(crate) struct SkeletonChoice {
    /// The skeleton file (SWC)
    pub(crate) skeleton: PathBuf,
    /// Repair what can be repaired: missing parents, cycles, missing radii, coincident samples, branches within the ball of their
    /// node; each repair is told
    #[arg(long)]
    pub(crate) repair: bool,
    /// Steps of smoothing along branches, radius included
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=100_000), value_name = "N")]
    pub(crate) smooth: u32,
    /// Distance of new samples along smooth branches, in micrometres
    #[arg(long, value_parser = spacing, value_name = "LENGTH")]
    pub(crate) spacing: Option<f64>,
}

fn spacing(text: &str) -> Result<f64, String> {
    magnitude(text).and_then(|length| {
        if length > 0.0 { Ok(length) } else { Err("expected a length above 0".to_owned()) }
    })
}
