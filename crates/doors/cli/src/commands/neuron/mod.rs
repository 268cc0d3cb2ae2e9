//! `pompeiu neuron`.

mod args;
mod checkpoint;
mod everything;
mod extraction;
mod json;
mod run;
mod source;
mod text;
mod transport;

pub(crate) use args::Neuron;
pub(crate) use run::run;

#[cfg(test)]
pub(crate) use json::Json;
