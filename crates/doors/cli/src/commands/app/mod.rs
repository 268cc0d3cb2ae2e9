//! `pompeiu app`.

mod args;
mod run;

pub(crate) use args::App;
pub(crate) use run::run;
