//! Options of the distance command.

use crate::aligned::Before;
use crate::args::{Limits, Meshes, Tolerance};
use crate::numbers::magnitude;
use clap::{Args, ValueEnum};

/// Enclose the distance between two meshes
#[derive(Args)]
#[command(after_help = "\
The directed distance h(A, B) is the largest distance of a point of A from B; H(A, B) is the larger of
h(A, B) and h(B, A). All points of all faces count, not only vertices. Faces are counted from 0.
In JSON, witness.a lies on A and witness.b on B in both directions.

Exit codes:
  0  done; with --assert-below: proven to be at most that
  1  with --assert-below: proven to exceed it
  2  a file or an argument cannot be used
  3  undecided within the time or memory limit, or within double precision

Examples:
  pompeiu distance model.obj scan.ply
  pompeiu distance model.obj scan.ply --direction a-to-b --json
  pompeiu distance model.obj scan.ply --tolerance 1e-3 --tolerance-kind relative
  pompeiu distance model.obj scan.ply --assert-below 0.05 --time-limit 10s")]
pub(crate) struct Distance {
    #[command(flatten)]
    pub(crate) meshes: Meshes,
    /// Move B onto A first, from any start; parts of either may have no counterpart
    #[arg(long, value_enum, value_name = "HOW")]
    pub(crate) align: Option<Before>,
    #[command(flatten)]
    pub(crate) tolerance: Tolerance,
    /// Which of the two directed distances to compute
    #[arg(long, value_enum, default_value_t)]
    pub(crate) direction: Direction,
    /// Ask only whether the distance is at most this length, and stop at the first proof
    #[arg(long, value_parser = magnitude, allow_negative_numbers = true, value_name = "LENGTH")]
    pub(crate) assert_below: Option<f64>,
    #[command(flatten)]
    pub(crate) limits: Limits,
    /// How to search
    #[arg(long, value_enum, default_value_t)]
    pub(crate) method: Method,
    /// Show how the interval narrows: a row per tolerance 1e-1, 1e-2, ... of the diagonal
    #[arg(long)]
    pub(crate) trace: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Direction {
    /// From A to B and from B to A: the symmetric distance
    #[default]
    Both,
    /// From A to B: how far points of A are from B
    AToB,
    /// From B to A: how far points of B are from A
    BToA,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Cover, generate and cut
    #[default]
    Fast,
    /// The textbook branch and bound: a baseline, slow at small tolerances
    Classic,
}
