//! The command line as typed values: what all commands have in common, and options that several share.

mod coordinates;
mod jobs;
mod limits;
mod many;
mod meshes;
mod output;
mod picture;
mod selection;
pub(crate) mod suffix;

pub(crate) use coordinates::{hold_in, tell};
pub(crate) use jobs::parse;
pub(crate) use limits::Limits;
pub(crate) use many::Many;
pub(crate) use meshes::Meshes;
pub(crate) use output::OutputFile;
pub(crate) use picture::Picture;
pub(crate) use selection::ForbidFile;

use crate::commands::Command;
use clap::Parser;
use clap::builder::styling::{AnsiColor, Styles};

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// Geometry processing with guarantees
///
/// How far are two surfaces apart, where, and can the number be trusted? Every distance is an interval that is proven to hold the
/// exact value, rounding included. Use `distance` for the largest distance alone, and `deviation` for mean, percentiles, regions,
/// verdicts and pages.
#[derive(Parser)]
#[command(version, name = "pompeiu", styles = STYLES, max_term_width = 100, after_help = "\
Examples:
  pompeiu distance model.obj scan.ply
  pompeiu distance model.obj scan.ply --within 0.05 && echo within 0.05
  pompeiu rank part.stl library/ --top 5
  pompeiu info model.obj
  pompeiu decompose torus.obj --field rotation:z -o parts.vtp
  pompeiu convert model.stl.gz model.ply
  pompeiu generate icosphere --subdivisions 5 -o sphere.obj

Files: OBJ, PLY, STL, OFF, glTF/GLB, VTK, VTP/VTU and 3MF, each also as .gz; recognised by content.
`pompeiu COMMAND --help` says more.")]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Print nothing but the answer and errors
    #[arg(long, short, global = true, display_order = 900)]
    pub(crate) quiet: bool,
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
