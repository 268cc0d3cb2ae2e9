//! What commands on many files have in common.

mod inputs;
mod journal;
mod meshes;
mod notes;

pub(crate) use inputs::expand;
pub(crate) use journal::{Fingerprint, Journal, fingerprint};
pub(crate) use meshes::Meshes;
pub(crate) use notes::Notes;

use crate::printer::Printer;
use serde::Serialize;

/// An input that could not be used, and why.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct Problem {
    /// The file, or the argument as given.
    pub(crate) path: String,
    /// One sentence.
    pub(crate) message: String,
}

impl Problem {
    /// Tells of all of them, one line each.
    pub(crate) fn report(problems: &[Self]) {
        for problem in problems {
            // Most messages name their file themselves.
            let text = if problem.message.starts_with(&problem.path) {
                problem.message.clone()
            } else {
                format!("{}: {}", problem.path, problem.message)
            };
            Printer::error(&anyhow::anyhow!(text));
        }
    }
}
