//! Frames of a flow for display.

use super::Streaks;
use super::streaks::square_curves;
use crate::State;
use crate::square::Square;

/// Largest number of values in a page, of some 20 bytes each.
const MOST_VALUES: usize = 2_000_000;

/// Largest number of frames in a page.
const MOST_FRAMES: usize = 120;

/// Smallest number of frames in a page.
const LEAST_FRAMES: usize = 8;

/// The number of frames in a page, for this many vertices and this many values at each.
pub fn most_frames(vertices: usize, values: usize) -> usize {
    (MOST_VALUES / (vertices * values).max(1)).clamp(LEAST_FRAMES, MOST_FRAMES)
}

/// A flow after a step, for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FluidFrame {
    /// Number of the step.
    pub step: usize,
    /// Vorticity at vertices.
    pub vorticity: Vec<f64>,
    /// Densities at vertices.
    pub densities: Vec<Vec<f64>>,
    /// Short curves along the velocity.
    pub curves: Vec<Vec<[f64; 3]>>,
}

impl FluidFrame {
    /// The current flow.
    pub fn new(state: &State, streaks: &Streaks<'_>) -> Self {
        Self {
            step: state.step,
            vorticity: state.vorticity.to_vec(),
            densities: state.densities.iter().map(|values| values.to_vec()).collect(),
            curves: streaks.curves(state),
        }
    }

    /// The current flow in the square, with a vertex for each cell.
    pub fn of_square(square: &Square) -> Self {
        Self {
            step: square.steps(),
            vorticity: square.vorticity(),
            densities: square.densities().to_vec(),
            curves: square_curves(square),
        }
    }
}
