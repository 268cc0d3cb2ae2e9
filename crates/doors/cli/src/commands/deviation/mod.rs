//! `pompeiu deviation`.

mod args;
mod bands;
mod csv;
mod full;
mod json;
mod meshes;
mod parts;
mod run;
mod text;
mod verdict;

pub(crate) use args::Deviation;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
