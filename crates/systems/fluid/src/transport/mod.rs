//! Transport of values at vertices or on faces along a velocity.

mod backtrace;
mod cells;
mod centroids;
mod flux_corrected;

pub(crate) use backtrace::{Backtrace, Departures, Passage, restore_mass};
pub(crate) use cells::Cells;
