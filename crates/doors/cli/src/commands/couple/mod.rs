//! `pompeiu couple`.

mod args;
mod json;
mod run;
mod scene;
mod text;

pub(crate) use args::Couple;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
