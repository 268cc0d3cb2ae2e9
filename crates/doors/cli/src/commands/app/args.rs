//! Options of the app command.

use clap::Args;
use std::path::PathBuf;

/// Compare, describe and change meshes in a page of the browser
#[derive(Args)]
#[command(after_help = "\
The page is that of pompeiu.html, but all cores and all memory of the machine work for it. It is served at 127.0.0.1 alone, at an \
address with a secret in it; requests of other pages are refused. Nothing is written but what you download. The program ends when the \
last page is closed, or with Ctrl-C.

Examples:
  pompeiu app
  pompeiu app model.stl scan.ply
  pompeiu app part.obj --port 8080 --no-browser")]
pub(crate) struct App {
    /// One mesh to describe and change, or two to compare
    #[arg(value_name = "FILE", num_args = 0..=2)]
    pub(crate) files: Vec<PathBuf>,
    /// The port of 127.0.0.1; any free one by default
    #[arg(long, default_value = "0", hide_default_value = true, value_name = "PORT")]
    pub(crate) port: u16,
    /// Print the address instead of opening it in the browser
    #[arg(long)]
    pub(crate) no_browser: bool,
}
