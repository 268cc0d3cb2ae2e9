//! Options of the medial command.

use crate::args::{Limits, Picture};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Fill a closed surface with few balls, and bound how far they are from it
#[derive(Args)]
#[command(after_help = "\
Balls are shrunk from points of the surface until they touch it on two sides, and then replaced by fewer ones. Edges join balls that
lie beside each other along the medial axis.

Outputs:
  .ma    balls and edges as text: v X Y Z RADIUS and e I J, after a line with their numbers
  .png   surface and balls beside each other
  .obj, .ply and other mesh files: a sphere of triangles for each ball

Examples:
  pompeiu medial cow.off -o cow.ma
  pompeiu medial cow.off --balls 50 --report balls.html --json")]
pub(crate) struct Medial {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    /// Number of balls
    #[arg(long, default_value = "30", value_name = "N")]
    pub(crate) balls: NonZeroUsize,
    /// Points of the surface from which balls are shrunk
    #[arg(long, default_value = "2000", value_name = "N")]
    pub(crate) samples: NonZeroUsize,
    /// Width of the interval of the distance from the surface to the balls, over the diagonal of the box around the surface
    #[arg(long, default_value = "0.001", value_name = "SHARE")]
    pub(crate) tolerance: f64,
    /// The file to write: .ma, .png or a mesh
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}
