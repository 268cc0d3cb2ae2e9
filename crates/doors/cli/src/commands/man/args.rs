//! Options of the man command.

use clap::Args;
use std::path::PathBuf;

/// Write the manual pages, one for each command
#[derive(Args)]
#[command(after_help = "\
Examples:
  pompeiu man -o ~/.local/share/man/man1 && man pompeiu-distance")]
pub(crate) struct Man {
    /// The folder to write to, made when it is missing
    #[arg(long, short, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
}
