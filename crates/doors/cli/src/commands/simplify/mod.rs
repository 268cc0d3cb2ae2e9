//! `pompeiu simplify`.

mod appearance;
mod args;
mod json;
mod run;
mod text;

pub(crate) use args::Simplify;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
