//! `pompeiu generate`.

mod args;
mod run;
mod shape;

pub(crate) use args::Generate;
pub(crate) use run::run;
