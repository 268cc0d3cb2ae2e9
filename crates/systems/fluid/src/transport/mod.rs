//! Carrying values at vertices along a velocity.

mod backtrace;
mod cells;
mod flux_corrected;

pub(crate) use backtrace::{Backtrace, restore_mass};
pub(crate) use cells::Cells;
