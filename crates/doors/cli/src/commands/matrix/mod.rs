//! `pompeiu matrix`.

mod args;
mod csv;
mod json;
mod run;

pub(crate) use args::Matrix;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
