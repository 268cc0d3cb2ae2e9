//! `pompeiu cut`.

mod args;
mod json;
mod run;
mod text;

pub(crate) use args::Cut;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
