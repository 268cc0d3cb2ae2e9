//! `pompeiu decompose`.

mod args;
mod json;
mod output;
mod run;
mod text;

pub(crate) use args::Decompose;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
