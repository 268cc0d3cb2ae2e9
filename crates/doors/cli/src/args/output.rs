//! The mesh file that a command is for.

use clap::Args;
use std::path::{Path, PathBuf};

/// The file to write: after the file to read, or as other commands take it.
#[derive(Args)]
pub(crate) struct OutputFile {
    /// The mesh file to write
    #[arg(value_name = "OUT", required_unless_present = "output")]
    second: Option<PathBuf>,
    /// The mesh file to write, in the place of OUT
    #[arg(short, long, value_name = "OUT", conflicts_with = "second")]
    output: Option<PathBuf>,
}

impl OutputFile {
    /// Its path.
    pub(crate) fn path(&self) -> &Path {
        // One of the two is required.
        self.second.as_deref().or(self.output.as_deref()).unwrap_or(Path::new(""))
    }
}
