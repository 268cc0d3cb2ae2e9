//! Options of the matrix command.

use crate::args::{Many, Tolerance};
use clap::Args;
use std::path::PathBuf;

/// Enclose the distances between all pairs of meshes
#[derive(Args)]
#[command(after_help = "\
Prints a line for each pair with the proven bounds on its symmetric distance, as comma-separated
values; --directed prints both directed distances instead, h(A, B) in the line from A to B. A folder
stands for the mesh files in it, by their suffixes; a pattern in quotes may hold *, ?, [abc] and **.

A limit or Ctrl-C ends the run with what is proven; the bounds of pairs that were not measured are
left empty.

Exit codes:
  0  done
  2  an argument or some of the files cannot be used; pairs of the others are measured
  3  a limit or Ctrl-C left pairs open

Examples:
  pompeiu matrix library/ > distances.csv
  pompeiu matrix 'scans/*.ply' --tolerance 1e-6 --resume scans.journal --json")]
pub(crate) struct Matrix {
    /// Files, folders and patterns, in the same unit
    #[arg(value_name = "FILES", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Give both directed distances of each pair
    #[arg(long)]
    pub(crate) directed: bool,
    #[command(flatten)]
    pub(crate) tolerance: Tolerance,
    /// Print one JSON object with square arrays
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) many: Many,
}
