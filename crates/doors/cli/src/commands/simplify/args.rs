//! Options of the simplify command.

use crate::args::{Centered, Intersections, Limits};
use crate::numbers::magnitude;
use clap::{ArgGroup, Args, ValueEnum};
use std::path::PathBuf;

/// How much time is spent on a small distance.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Effort {
    Best,
    Fast,
}

/// Reduce the number of faces within a distance that is proven
#[derive(Args)]
#[command(group = ArgGroup::new("target").required(true).args(["within", "relative", "faces"]), override_usage = "\
pompeiu simplify [OPTIONS] --output <OUT>
       <--within <LENGTH>|--relative <FRACTION>|--faces <N>> <MESH>", after_help = "\
Edges are collapsed in order of their quadric error. With --within or --relative each collapse is tested on both sides, and the
Pompeiu–Hausdorff distance of the result is proven to be at most that length; otherwise nothing is written. With --faces the
distance follows, and is proven too. The mesh must be an oriented manifold, with or without boundary, or be repaired (--repair).
Colours of vertices (PLY, OBJ), texture coordinates and materials (OBJ) are carried over, and seams are kept as curves, if the output has
a place for them. Normals are not in the output.

Examples:
  pompeiu simplify scan.ply --within 0.05 -o light.ply
  pompeiu simplify scan.ply --relative 0.001 -o light.ply --json
  pompeiu simplify scan.ply --faces 5000 -o light.glb
  pompeiu simplify scan.ply --relative 0.02 --levels 4 -o light.ply")]
pub(crate) struct Simplify {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    /// Largest distance from the input, in its unit
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) within: Option<f64>,
    /// Largest distance as a fraction of the diagonal of the bounding box
    #[arg(long, value_parser = magnitude, value_name = "FRACTION")]
    pub(crate) relative: Option<f64>,
    /// Number of faces to reach
    #[arg(long, value_name = "N")]
    pub(crate) faces: Option<usize>,
    /// With --faces: `best` tests every collapse and comes as near to the input as it can, `fast` goes by quadric errors alone, in a tenth of
    /// the time and with mostly two to three times the distance
    #[arg(long, value_name = "EFFORT", default_value = "best", requires = "faces")]
    pub(crate) effort: Effort,
    /// Keep edges whose faces meet at more than this angle between their normals, in degrees, and boundaries: as curves with the same
    /// corners
    #[arg(long, value_parser = magnitude, value_name = "ANGLE")]
    pub(crate) features: Option<f64>,
    /// Repair the mesh first, as `pompeiu repair` does; the distance is measured from the mesh as it was
    #[arg(long)]
    pub(crate) repair: bool,
    #[command(flatten)]
    pub(crate) guard: Intersections,
    #[command(flatten)]
    pub(crate) centered: Centered,
    /// Write so many levels of detail: OUT, and before its suffix `-1`, `-2`, ... for meshes with half the distance, or twice the
    /// number of faces, of the one before
    #[arg(long, value_name = "N", default_value_t = 1, hide_default_value = true,
        value_parser = clap::value_parser!(u8).range(1..=32))]
    pub(crate) levels: u8,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}
