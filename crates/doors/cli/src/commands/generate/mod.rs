//! `pompeiu generate`.

mod args;
mod planar;
mod run;
mod shape;

pub(crate) use args::Generate;
pub(crate) use run::run;
