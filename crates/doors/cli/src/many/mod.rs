//! What commands on many files have in common.

mod collection;
mod inputs;
mod journal;
mod meshes;
mod notes;

pub(crate) use collection::{Collection, show};
pub(crate) use inputs::expand;

use crate::printer::Printer;
use pompeiu::matching::Unusable;

/// Reports inputs that could not be used, one line each.
pub(crate) fn report(problems: &[Unusable]) {
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
