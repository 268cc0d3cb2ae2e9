//! Options of the matrix command.

use crate::args::Many;
use crate::numbers::magnitude;
use clap::Args;
use std::path::PathBuf;

/// Enclose the distances between all pairs of meshes
#[derive(Args)]
#[command(after_help = "\
Prints a line for each pair with the proven bounds on its symmetric distance, as comma-separated
values; --directed prints both directed distances instead, h(A, B) in the line from A to B. A folder
stands for the mesh files in it, by their suffixes; a pattern in quotes may hold *, ?, [abc] and **.

Exit codes:
  0  done
  2  an argument or some of the files cannot be used; pairs of the others are measured

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
    /// Largest width of the proven intervals, as a fraction of the diagonal of the box around both meshes
    #[arg(long, value_parser = magnitude, allow_negative_numbers = true, default_value = "1e-12", value_name = "X")]
    pub(crate) tolerance: f64,
    /// Print one JSON object with square arrays
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) many: Many,
}
