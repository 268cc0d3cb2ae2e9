//! Options of the align command.

use crate::args::Limits;
use crate::numbers::share;
use clap::Args;
use std::path::PathBuf;

/// Move one mesh onto another, from any start, also if only parts match
#[derive(Args)]
#[command(after_help = "\
The rotation and translation are found from the shapes: it does not matter how the files lie, and parts of either mesh may
have no counterpart in the other. What is found is a guess, so the answer says how much of the moved surface is matched and how
well, which other places fit nearly as well, which motions leave the fit as it is, and whether anything fits at all. The
distances of the moved mesh are proven. Both meshes must be in the same unit; with --scale one factor is found too, which needs
meshes that overlap nearly whole, and told with its standard deviation.

The matrix is that of the map as four rows that act on columns (x, y, z, 1), as CloudCompare takes it under \"Apply transformation\".
The row ParaView holds what its filter Transform takes.

Exit codes:
  0  done
  2  a file or an argument cannot be used
  3  the time limit ran out first, or nothing fits: the shapes seem to be different ones

Examples:
  pompeiu align scan.ply model.obj -o moved.ply
  pompeiu align part.stl whole.stl --robust 0.3 --matrix part.txt
  pompeiu align inches.obj model.obj --scale -o moved.obj --json")]
pub(crate) struct Align {
    /// The mesh file to move
    #[arg(value_name = "MOVING")]
    pub(crate) moving: PathBuf,
    /// The mesh file that stays
    #[arg(value_name = "FIXED")]
    pub(crate) fixed: PathBuf,
    /// Write the moved mesh
    #[arg(long, short, value_name = "MOVED")]
    pub(crate) output: Option<PathBuf>,
    /// Write the matrix as text, four rows of four numbers: what `CloudCompare` reads
    #[arg(long, value_name = "FILE")]
    pub(crate) matrix: Option<PathBuf>,
    /// Find a factor of scale, too
    #[arg(long)]
    pub(crate) scale: bool,
    /// The share of the moving surface's area that has a counterpart, such as 0.5; without it the spread of the distances tells
    #[arg(long, value_parser = share, value_name = "SHARE")]
    pub(crate) robust: Option<f64>,
    #[command(flatten)]
    pub(crate) limits: Limits,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
