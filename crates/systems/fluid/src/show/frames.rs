//! A flow as it is shown at a time.

use super::Streaks;
use super::streaks::square_curves;
use crate::State;
use crate::square::Square;

/// Values that a page holds at most, some 20 bytes each.
const MOST_VALUES: usize = 2_000_000;

/// Frames that a page plays at most.
const MOST_FRAMES: usize = 120;

/// Frames that a page plays at least.
const LEAST_FRAMES: usize = 8;

/// How many frames of a surface with this many vertices a page can play, with this many values at each.
pub fn most_frames(vertices: usize, values: usize) -> usize {
    (MOST_VALUES / (vertices * values).max(1)).clamp(LEAST_FRAMES, MOST_FRAMES)
}

/// A flow after a step, to be shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FluidFrame {
    /// Number of the step.
    pub step: usize,
    /// Vorticity at vertices.
    pub vorticity: Vec<f64>,
    /// Densities at vertices.
    pub densities: Vec<Vec<f64>>,
    /// Curves along the velocity.
    pub curves: Vec<Vec<[f64; 3]>>,
}

impl FluidFrame {
    /// The flow as it is.
    pub fn new(state: &State, streaks: &Streaks<'_>) -> Self {
        Self {
            step: state.step,
            vorticity: state.vorticity.to_vec(),
            densities: state.densities.iter().map(|values| values.to_vec()).collect(),
            curves: streaks.curves(state),
        }
    }

    /// The flow in the square as it is, with a vertex for each cell.
    pub fn of_square(square: &Square) -> Self {
        Self {
            step: square.steps(),
            vorticity: square.vorticity(),
            densities: square.densities().to_vec(),
            curves: square_curves(square),
        }
    }
}
