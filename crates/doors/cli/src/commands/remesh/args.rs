//! Options of the remesh command.

use crate::args::{Centered, Intersections, Limits, Picture};
use crate::numbers::magnitude;
use clap::{ArgGroup, Args};
use pompeiu::remesh::RemeshOptions;
use std::path::PathBuf;

/// Give a mesh nearly equilateral faces of a wanted size
#[derive(Args)]
#[command(group = ArgGroup::new("size").required(true).args(["edge_length", "relative", "adaptive"]), override_usage = "\
pompeiu remesh [OPTIONS] --output <OUT>
       <--edge-length <LENGTH>|--relative <FRACTION>|--adaptive <HEIGHT>> <MESH>", after_help = "\
Edges are split, collapsed and flipped, vertices move within the surface and onto the input. Topology, boundaries and the edges
that --features names are kept. The Pompeiu–Hausdorff distance from the input is measured; with --within it is proven to be at
most that length, for which edges are shortened where they must be; otherwise nothing is written. The mesh must be an oriented
manifold, with or without boundary. Only positions and faces are read: colours, normals and texture coordinates are not in the
output.

Examples:
  pompeiu remesh scan.ply --edge-length 0.5 -o even.ply
  pompeiu remesh part.stl --relative 0.01 --features 40 -o even.ply
  pompeiu remesh scan.ply --adaptive 0.01 --within 0.05 -o light.ply --report light.html")]
pub(crate) struct Remesh {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    /// Length of edges, in the unit of the mesh
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) edge_length: Option<f64>,
    /// Length of edges as a fraction of the diagonal of the bounding box
    #[arg(long, value_parser = magnitude, value_name = "FRACTION")]
    pub(crate) relative: Option<f64>,
    /// Height of chords: edges are as long as the curvature allows
    #[arg(long, value_parser = magnitude, value_name = "HEIGHT")]
    pub(crate) adaptive: Option<f64>,
    /// Largest distance from the input, in its unit, to be proven
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) within: Option<f64>,
    /// Keep edges whose faces meet at more than this angle between their normals, in degrees
    #[arg(long, value_parser = magnitude, value_name = "ANGLE")]
    pub(crate) features: Option<f64>,
    /// Rounds of splits, collapses, flips and moves
    #[arg(long, value_name = "N", default_value_t = RemeshOptions::ITERATIONS)]
    pub(crate) iterations: usize,
    /// Most faces that the result may have
    #[arg(long, value_name = "N", default_value_t = RemeshOptions::MOST_FACES)]
    pub(crate) most_faces: usize,
    #[command(flatten)]
    pub(crate) guard: Intersections,
    #[command(flatten)]
    pub(crate) centered: Centered,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}
