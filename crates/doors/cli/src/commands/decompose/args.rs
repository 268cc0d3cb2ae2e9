//! Options of the decompose command.

use crate::args::Picture;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Split a tangent field into a gradient, a rotated gradient and a harmonic part
#[derive(Args)]
#[command(after_help = "\
The mesh must be an oriented manifold, with or without boundary. The parts add up to the field and are orthogonal to each
other; the report says how nearly. Without a field only the degrees of freedom are counted.

Fields:
  FILE             a vector for each face: VTP or VTU cell data, PLY properties NAME_x, NAME_y, NAME_z, or CSV
  rotation:AXIS    rotation about an axis through the origin, x, y, z or three numbers: 0,1,1
  gradient:WHAT    gradient of a coordinate, of a direction such as 0,1,1, or of an expression such as sin(x)*y^2
  random:SEED      random vectors
  harmonic:K       the harmonic field with number K, from 0

OUT is VTP, VTU or PLY, or VTP.gz: vectors field, gradient, rotated and harmonic on faces, and both potentials, one on vertices
and one on faces (its value at their centres).

Examples:
  pompeiu decompose torus.obj --field rotation:z -o parts.vtp
  pompeiu decompose torus.obj --field rotation:z --image parts.png --up z
  pompeiu decompose scan.ply --field wind.csv --json
  pompeiu decompose open.obj --field gradient:x*y --boundary normal
  pompeiu decompose fertility.off")]
pub(crate) struct Decompose {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    /// The field to split
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub(crate) field: Option<String>,
    /// Which vectors of the file, if it has several
    #[arg(long, value_name = "NAME", requires = "field")]
    pub(crate) name: Option<String>,
    /// Which kind of function makes gradients
    #[arg(long, value_enum, default_value_t)]
    pub(crate) splitting: Splitting,
    /// How the harmonic part meets the boundary
    #[arg(long, value_enum, default_value_t)]
    pub(crate) boundary: Boundary,
    /// Write the field, its parts and their potentials
    #[arg(long, short, value_name = "OUT", requires = "field")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub(crate) enum Splitting {
    /// Gradients of continuous functions, rotated gradients of functions that agree at midpoints of edges
    #[default]
    Primal,
    /// The other way round
    Dual,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub(crate) enum Boundary {
    /// Along it: nothing flows through
    #[default]
    Tangential,
    /// Straight through it
    Normal,
}
