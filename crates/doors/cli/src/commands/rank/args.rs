//! Options of the rank command.

use crate::args::{Many, Tolerance};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Rank meshes by their distance from a template
#[derive(Args)]
#[command(after_help = "\
The targets are ranked by their Pompeiu–Hausdorff distance from the template: all points of all
faces count. A target is discarded as soon as it is proven to be farther than the K best. Where
distances cannot be told apart, ranks are given as a range. The answer does not depend on the order
of the targets or the number of threads.

A folder stands for the mesh files in it, by their suffixes; a pattern in quotes may hold *, ?,
[abc] and **. With --align, distances hold for the targets as moved, their coordinates rounded; a
rigid alignment is a local optimum.

A limit or Ctrl-C ends the ranking with what is proven: targets that are not settled are open, with
the bounds and the ranks known so far.

Exit codes:
  0  done
  2  the template, an argument, or some of the targets cannot be used; the others are ranked
  3  a limit or Ctrl-C left targets open

Examples:
  pompeiu rank part.stl library/ --top 5
  pompeiu rank part.stl 'library/**/*.stl' --align rigid --resume part.journal --csv part.csv
  pompeiu rank tooth.ply scans/ --direction from-template --json")]
pub(crate) struct Rank {
    /// The mesh file to compare with
    #[arg(value_name = "TEMPLATE")]
    pub(crate) template: PathBuf,
    /// Files, folders and patterns, in the same unit
    #[arg(value_name = "TARGETS", required = true)]
    pub(crate) targets: Vec<PathBuf>,
    /// How many of the best to find; those that tie with the last come too
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..), default_value = "10", value_name = "K")]
    pub(crate) top: u32,
    /// Measure every target in full
    #[arg(long)]
    pub(crate) all: bool,
    /// Which distance to rank by
    #[arg(long, value_enum, default_value_t)]
    pub(crate) direction: RankDirection,
    /// How to move targets onto the template first
    #[arg(long, value_enum, default_value_t)]
    pub(crate) align: Align,
    #[command(flatten)]
    pub(crate) tolerance: Tolerance,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a table of all targets to this file
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) many: Many,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum RankDirection {
    /// The symmetric distance
    #[default]
    Both,
    /// How far the template is from the target: finds what the template is a part of
    FromTemplate,
    /// How far the target is from the template: finds parts of the template
    ToTemplate,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Align {
    /// Not at all
    #[default]
    None,
    /// Bring the centroids of the surfaces together
    Centroid,
    /// That, and make the root-mean-square radii equal
    Scale,
    /// Turn and move to the best place found from many starts
    Rigid,
}
