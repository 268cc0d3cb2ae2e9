//! Options of the repair command.

use crate::args::Centered;
use crate::numbers::magnitude;
use clap::Args;
use std::path::PathBuf;

/// Make a mesh an oriented manifold, and say what was done
#[derive(Args)]
#[command(after_help = "\
In this order: drops vertices in no face, makes one vertex of those at one position, drops degenerate and duplicate faces, gives
each fan of faces around a vertex a vertex of its own so that no edge has more than two faces, turns faces to agree, fills holes
when asked. With --within the Pompeiu–Hausdorff distance of the result from the input is proven to be at most that length;
otherwise nothing is written, and the exit code is 1.

Examples:
  pompeiu repair scan.stl clean.ply
  pompeiu repair scan.ply clean.ply --weld 0.001 --within 0.01
  pompeiu repair scan.ply closed.ply --fill-holes 30 --json")]
pub(crate) struct Repair {
    /// The mesh file to read
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,
    /// The mesh file to write
    #[arg(value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// Make one vertex of those within this length of each other, not only of those at one position
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) weld: Option<f64>,
    /// Leave vertices at one position apart
    #[arg(long, conflicts_with = "weld")]
    pub(crate) no_weld: bool,
    /// Fill boundary loops with at most this many edges
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub(crate) fill_holes: usize,
    /// Largest distance from the input, in its unit, to be proven
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) within: Option<f64>,
    #[command(flatten)]
    pub(crate) centered: Centered,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
