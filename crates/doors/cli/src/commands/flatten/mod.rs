//! `pompeiu flatten`.

mod args;
mod json;
mod output;
mod run;
mod text;

pub(crate) use args::Flatten;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
