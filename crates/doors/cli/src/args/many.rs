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
    /// Memory for meshes that are kept between uses; others are read again
    #[arg(long, value_parser = memory, default_value = "1GiB", value_name = "SIZE")]
    pub(crate) cache: usize,
}

impl Many {
    /// Bytes for meshes that are kept: at most half of the memory, so that searches have the other.
    pub(crate) fn cache(&self, memory: Option<usize>) -> usize {
        memory.map_or(self.cache, |memory| self.cache.min(memory / 2))
    }
}
