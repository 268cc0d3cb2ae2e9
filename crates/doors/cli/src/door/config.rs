//! Options from a file.

use super::System;
use anyhow::{Context, anyhow};
use pompeiu::options::{Options, OptionsError, request_from};
use std::path::Path;

/// The options in a file, each of which can be used.
pub(super) fn read<S: System>(path: &Path) -> anyhow::Result<Options> {
    crate::files::check_readable(path)?;
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let usable = S::options_in(path, &text).and_then(|options| {
        request_from::<S::Request>(options.clone())?;
        Ok(options)
    });
    usable.map_err(|error| {
        let line = match &error {
            OptionsError::Unknown { name, .. } | OptionsError::Value { name, .. } => line_of(&text, name),
            _ => None,
        };
        let line = line.map_or_else(String::new, |line| format!("line {line}: "));
        anyhow!("{}: {line}{error}", path.display())
    })
}

/// The line on which an option is set, from 1.
fn line_of(text: &str, name: &str) -> Option<usize> {
    let sets = |line: &str| {
        let line = line.trim_start();
        let table = line.trim_start_matches('[').strip_prefix(name);
        let value = line.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('='));
        value || (line.starts_with('[') && table.is_some_and(|rest| rest.starts_with(']')))
    };
    Some(1 + text.lines().position(sets)?)
}
