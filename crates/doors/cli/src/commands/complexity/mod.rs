//! `pompeiu complexity`.

mod args;
mod input;
mod json;
mod run;
mod text;

pub(crate) use args::Complexity;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
