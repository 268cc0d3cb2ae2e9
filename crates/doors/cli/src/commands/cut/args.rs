//! Options of the cut command.

use crate::args::CutChoice;
use clap::Args;
use std::path::PathBuf;

/// Open a surface along edges, so that each part becomes a disk
#[derive(Args)]
#[command(after_help = "\
The mesh must be a manifold. Faces and their corners stay as they are; a vertex gets a copy for each part that the cut makes of
its faces. The first copy keeps the number of the vertex, so that gluing gives the input back.

Examples:
  pompeiu cut torus.obj -o disk.obj
  pompeiu cut cow.off --strategy tips -o cow-open.ply
  pompeiu cut ball.ply --through 0,17,230 -o ball-open.ply")]
pub(crate) struct Cut {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    #[command(flatten)]
    pub(crate) choice: CutChoice,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
