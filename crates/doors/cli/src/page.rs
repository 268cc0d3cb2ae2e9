//! Answers for people: rows of a name and a line each.

use crate::numbers::{agreed, between};
use crate::pair::File;
use crate::printer::LABEL;
use pompeiu::hausdorff::Enclosure;
use std::fmt::Write;

/// Width of the column of names.
const NAMES: usize = 10;

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
    pub(crate) fn files(&mut self, a: &File, b: &File) {
        for (name, file) in [("A", a), ("B", b)] {
            self.row(name, &file.described());
        }
    }

    pub(crate) fn gap(&mut self) {
        self.0.push('\n');
    }
}

/// What an enclosed value is, in the digits that are certain.
pub(crate) fn value(distance: Enclosure) -> String {
    let (lower, upper) = (distance.lower(), distance.upper());
    agreed(lower, upper).unwrap_or_else(|| between(lower, upper))
}
