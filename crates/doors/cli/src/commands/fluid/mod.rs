//! `pompeiu fluid`.

mod args;
mod build;
mod checkpoint;
mod json;
pub(crate) mod reader;
mod run;
mod scene;
mod square;
mod stage;
mod text;

pub(crate) use args::Fluid;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
