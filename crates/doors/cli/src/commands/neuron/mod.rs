//! `pompeiu neuron`.

mod args;
mod everything;
mod json;
mod run;
mod text;
mod transport;

pub(crate) use args::Neuron;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
