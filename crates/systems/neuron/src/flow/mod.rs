//! Steady viscous flow through a neuron.

mod element;
mod error;
mod problem;
mod run;
mod system;

pub use error::FlowError;
pub use problem::{Drive, FlowOptions, FlowParameters};
pub use run::{Flow, FlowEnd, FlowReport, neuron_flow};
pub use system::{FlowSolution, FlowSystem, NEWTON_TOLERANCE};
