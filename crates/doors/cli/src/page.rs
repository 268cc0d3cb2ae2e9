//! Answers for people: rows of a name and a line each.

use crate::numbers::{self, agreed, between};
use crate::pair::File;
use crate::printer::LABEL;
use pompeiu::core::request::Input;
use pompeiu::hausdorff::Enclosure;
use std::fmt::Write;

/// Width of the column of names.
const NAMES: usize = 10;
/// Width of the first of two columns.
const COLUMN: usize = 32;

/// Rows of a name and a line each.
pub(crate) struct Page(String);

impl Page {
    pub(crate) fn new() -> Self {
        Self(String::new())
    }

    pub(crate) fn into_text(self) -> String {
        self.0
    }

    pub(crate) fn row(&mut self, name: &str, line: &str) {
        let padding = NAMES.saturating_sub(name.chars().count());
        let _ = match name {
            "" => writeln!(self.0, "{:padding$}{line}", ""),
            _ => writeln!(self.0, "{LABEL}{name}{LABEL:#}{:padding$}{line}", ""),
        };
    }

    /// What was compared.
    pub(crate) fn files(&mut self, [a_name, b_name]: [&str; 2], a: &File, b: &File) {
        for (name, file) in [(a_name, a), (b_name, b)] {
            self.row(name, &file.described());
        }
    }

    /// A name, and the same of two things beside each other.
    pub(crate) fn columns(&mut self, name: &str, [left, right]: [&str; 2]) {
        self.row(name, format!("{left:COLUMN$}{right}").trim_end());
    }

    pub(crate) fn gap(&mut self) {
        self.0.push('\n');
    }
}

/// The path and the counts of an input.
pub(crate) fn described(input: &Input) -> String {
    let [vertices, faces] = [input.vertices, input.faces].map(|n| numbers::grouped(n as u64));
    format!("{}: {vertices} vertices, {faces} faces", input.path.as_deref().unwrap_or_default())
}

/// What an enclosed value is, in no more digits than tell it from others.
pub(crate) fn brief(distance: Enclosure) -> String {
    numbers::brief(distance.lower(), distance.upper())
}

/// What an enclosed value is, in the digits that are certain.
pub(crate) fn value(distance: Enclosure) -> String {
    let (lower, upper) = (distance.lower(), distance.upper());
    agreed(lower, upper).unwrap_or_else(|| between(lower, upper))
}
