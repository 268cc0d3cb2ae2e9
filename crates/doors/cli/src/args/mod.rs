//! The command line as typed values.

mod decompose;
mod deviation;
mod distance;
mod limits;
mod many;
mod matrix;
mod picture;
mod rank;
mod shape;

pub(crate) use decompose::{Boundary, Decompose, FieldSource, Splitting};
pub(crate) use deviation::Deviation;
pub(crate) use distance::{Direction, Distance, Method, ToleranceKind};
pub(crate) use matrix::Matrix;
pub(crate) use rank::{Align, Rank, RankDirection};
pub(crate) use shape::{Finish, Shape};

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Parser, Subcommand};
use std::path::PathBuf;

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// Certified Pompeiu–Hausdorff distance between triangle meshes
///
/// Computes an interval that is proven to hold the largest distance from any point of one surface to the other, rounding
/// included, and the pair of points that proves it.
#[derive(Parser)]
#[command(version, name = "pompeiu", styles = STYLES, max_term_width = 100, after_help = "\
Examples:
  pompeiu distance scan.ply model.obj
  pompeiu distance scan.ply model.obj --assert-below 0.05 && echo within 0.05
  pompeiu rank part.stl library/ --top 5
  pompeiu info model.obj
  pompeiu decompose torus.obj --field rotation:z -o parts.vtp
  pompeiu convert model.stl.gz model.ply
  pompeiu generate icosphere --subdivisions 5 -o sphere.obj

Files: OBJ, PLY, STL, OFF, glTF/GLB, VTK and VTP/VTU, each also as .gz; recognised by content.
`pompeiu COMMAND --help` says more.")]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Print nothing but the answer and errors
    #[arg(long, short, global = true, display_order = 900)]
    pub(crate) quiet: bool,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Enclose the distance between two meshes
    Distance(Distance),
    /// Show how far two meshes deviate: where, on which side, over how much of the area
    Deviation(Deviation),
    /// Rank meshes by their distance from a template
    Rank(Rank),
    /// Enclose the distances between all pairs of meshes
    Matrix(Matrix),
    /// Describe a mesh: counts, size, area, volume, topology, oddities
    Info(Info),
    /// Split a tangent field into a gradient, a rotated gradient and a harmonic part
    Decompose(Decompose),
    /// Read a mesh in one format and write it in another
    Convert(Convert),
    /// Make a mesh of a shape that is known exactly, or edit one
    Generate(Generate),
    /// Print a completion script for a shell
    #[command(after_help = "\
Examples:
  pompeiu completions bash > ~/.local/share/bash-completion/completions/pompeiu
  pompeiu completions zsh > ~/.zfunc/_pompeiu
  pompeiu completions fish > ~/.config/fish/completions/pompeiu.fish")]
    Completions(Completions),
    /// Write the manual pages, one for each command
    #[command(after_help = "\
Examples:
  pompeiu man -o ~/.local/share/man/man1 && man pompeiu-distance")]
    Man(Man),
}

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pompeiu info bunny.ply
  pompeiu info bunny.ply --json")]
pub(crate) struct Info {
    /// The mesh file
    pub(crate) file: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(clap::Args)]
#[command(after_help = "\
The suffix of OUT names the format: obj, ply, stl, off, vtp, vtu or glb, and .gz after it compresses.
OUT appears, or is replaced, only once all of it is written.

Examples:
  pompeiu convert part.stl part.ply
  pompeiu convert part.ply part.obj.gz")]
pub(crate) struct Convert {
    /// The mesh file to read
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,
    /// The mesh file to write
    #[arg(value_name = "OUT")]
    pub(crate) output: PathBuf,
}

#[derive(clap::Args)]
#[command(after_help = "\
The same arguments give the same file, bit for bit, on every machine.

Examples:
  pompeiu generate icosphere --radius 2 --subdivisions 5 -o sphere.ply
  pompeiu generate schwarz-lantern --segments 12 --bands 40 -o lantern.obj
  pompeiu generate torus --noise 0.01 --seed 7 -o rough.obj
  pompeiu generate cube --cells 4 --rotate 1,1,0,30 --translate 0,0,1 -o tilted.stl
  pompeiu generate mesh scan.ply --subdivide 1 --shuffle 1 -o same.ply")]
pub(crate) struct Generate {
    #[command(subcommand)]
    pub(crate) shape: Shape,
}

#[derive(clap::Args)]
pub(crate) struct Completions {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[derive(clap::Args)]
pub(crate) struct Man {
    /// The folder to write to, made when it is missing
    #[arg(long, short, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_well_formed() {
        Args::command().debug_assert();
    }
}
