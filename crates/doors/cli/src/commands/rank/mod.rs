//! `pompeiu rank`.

mod args;
mod csv;
mod json;
mod run;
mod text;

pub(crate) use args::Rank;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
