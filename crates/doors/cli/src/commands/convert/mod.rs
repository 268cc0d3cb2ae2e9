//! `pompeiu convert`.

mod args;
mod run;

pub(crate) use args::Convert;
pub(crate) use run::run;
