//! Transport of material through a meshed neuron.
//!
//! Finite volumes on the hexahedra: concentrations are constant on each cell, and the flux out of a cell is the flux into its
//! neighbour. Advection is upwind and diffusion uses two-point fluxes, so that with backward Euler steps every concentration is a
//! weighted mean of others with nonnegative weights.

mod config;
mod discretisation;
mod error;
mod factor;
mod flow;
mod parts;
mod problem;
mod run;
mod state;
mod step;
mod system;
mod units;
mod viscous;

pub use config::read_transport_config;
pub use discretisation::Discretisation;
pub use error::TransportError;
pub use flow::{FlowField, potential_flow};
pub(crate) use parts::labels_of_parts;
pub use problem::{Parameters, TimeScheme, TransportOptions};
pub use run::{TipReport, Transport, TransportReport, transport, transport_in_flow};
pub use state::{Frame, TransportState};
pub use viscous::FlowCells;
