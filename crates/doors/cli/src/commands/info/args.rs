//! Options of the info command.

use clap::Args;
use std::path::PathBuf;

/// Describe a mesh: counts, size, area, volume, topology, oddities
#[derive(Args)]
#[command(after_help = "\
Examples:
  pompeiu info bunny.ply
  pompeiu info bunny.ply --json
  pompeiu info bunny.ply --intersections")]
pub(crate) struct Info {
    /// The mesh file
    pub(crate) file: PathBuf,
    /// Find pairs of faces that intersect, decided exactly
    #[arg(long)]
    pub(crate) intersections: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
