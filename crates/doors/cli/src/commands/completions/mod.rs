//! `pompeiu completions`.

mod args;
mod run;

pub(crate) use args::Completions;
pub(crate) use run::run;
