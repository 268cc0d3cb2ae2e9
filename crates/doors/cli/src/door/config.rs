//! Options from a file.

use super::System;
use anyhow::Context;
use pompeiu::options::Options;
use std::fmt::Display;
use std::path::Path;

/// The options in a file.
pub(super) fn read<S: System>(path: &Path) -> anyhow::Result<Options> {
    crate::files::check_readable(path)?;
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    S::options_in(path, &text).map_err(|error| in_file(path, &error))
}

/// An error with the file that it may lie in.
pub(super) fn in_file(path: &Path, error: &impl Display) -> anyhow::Error {
    anyhow::anyhow!("{}: {error}", path.display())
}
