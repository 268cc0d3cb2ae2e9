//! Options that commands on many files share.

use crate::numbers::memory;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Many {
    /// Look into the folders in folders too
    #[arg(long)]
    pub(crate) recursive: bool,
    /// Note each result in this file, and take from it what an earlier run has noted
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    /// Threads to use; all processors by default
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024), value_name = "N")]
    pub(crate) threads: Option<u16>,
    /// Memory for meshes that are kept between uses; others are read again
    #[arg(long, value_parser = memory, default_value = "1GiB", value_name = "SIZE")]
    pub(crate) cache: usize,
}
