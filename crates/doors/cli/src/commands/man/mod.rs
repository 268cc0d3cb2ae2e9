//! `pompeiu man`.

mod args;
mod run;

pub(crate) use args::Man;
pub(crate) use run::run;
