//! Transport of material through a meshed neuron.
//!
//! Finite volumes on the hexahedra: concentrations are constant on each cell, material goes through faces, what leaves a cell enters its
//! neighbour. Advection is upwind and diffusion goes along the lines between cells, so that with backward Euler steps every
//! concentration is a mean of others with weights that are not negative.

mod config;
mod discretisation;
mod error;
mod flow;
mod parts;
mod problem;
mod run;
mod step;
mod system;
mod units;
mod viscous;

pub use config::read_transport_config;
pub use discretisation::Discretisation;
pub use error::TransportError;
pub use flow::{FlowField, potential_flow};
pub use problem::{Parameters, TimeScheme, TransportOptions};
pub use run::{Frame, TipReport, Transport, TransportReport, TransportState, transport, transport_in_flow};
pub use viscous::FlowCells;
pub(crate) use viscous::labels_of_parts;
