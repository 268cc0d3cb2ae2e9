//! `pompeiu medial`.

mod args;
mod json;
mod run;
mod text;

pub(crate) use args::Medial;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
