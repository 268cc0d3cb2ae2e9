//! `pompeiu distance`.

mod args;
mod json;
mod outcome;
mod run;
mod text;
mod watch;

pub(crate) use args::Distance;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
