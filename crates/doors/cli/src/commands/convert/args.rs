//! Options of the convert command.

use crate::args::OutputFile;
use clap::Args;
use std::path::PathBuf;

/// Read a mesh in one format and write it in another
#[derive(Args)]
#[command(after_help = "\
The suffix of OUT names the format: obj, ply, stl, off, vtp, vtu or glb, and .gz after it compresses.
OUT appears, or is replaced, only once all of it is written.
Colours, texture coordinates, normals and materials of OBJ, PLY and glTF are kept where OUT has a
place for them; what is not kept is said.

Examples:
  pompeiu convert part.stl part.ply
  pompeiu convert part.ply part.obj.gz")]
pub(crate) struct Convert {
    /// The mesh file to read
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) output: OutputFile,
}
