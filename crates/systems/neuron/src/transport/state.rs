//! The state of a transport, from which it can be resumed.

use super::error::TransportError;
use super::step::Stepped;
use super::system::System;

/// The state after a step. A run can be resumed from it with the same bits ([`TransportOptions::resume`](super::TransportOptions::resume)).
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransportState {
    /// The step, from 0 for the initial state.
    pub step: usize,
    /// For each step, including the initial state, and each flat end: the mean concentrations n₀, n₊, n₋ over its faces.
    pub ends: Vec<Vec<[f64; 3]>>,
    /// The whole field at some steps.
    pub frames: Vec<Frame>,
    /// The field; the kinds of a cell are adjacent.
    pub(super) values: Vec<f64>,
    pub(super) book: MassBalance,
}

impl TransportState {
    /// Checks that it belongs to a mesh with this many cells and ends, and is not beyond the last step.
    pub(super) fn check(&self, cells: usize, caps: usize, steps: usize) -> Result<(), TransportError> {
        let wrong = |what, found, expected| Err(TransportError::State { what, found, expected });
        if self.values.len() != 3 * cells {
            return wrong("cells", self.values.len() / 3, cells);
        }
        if self.step > steps {
            return wrong("steps", self.step, steps);
        }
        if self.ends.len() != self.step + 1 {
            return wrong("rows of ends", self.ends.len(), self.step + 1);
        }
        if let Some(row) = self.ends.iter().find(|row| row.len() != caps) {
            return wrong("flat ends", row.len(), caps);
        }
        if let Some(frame) = self.frames.iter().find(|frame| frame.values.len() != cells) {
            return wrong("cells in a frame", frame.values.len(), cells);
        }
        Ok(())
    }
}

/// The field at a step.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Frame {
    /// The step, from 0 for the initial state.
    pub step: usize,
    /// The time in seconds.
    pub time: f64,
    /// n₀, n₊, n₋ of each cell.
    pub values: Vec<[f64; 3]>,
}

/// The mass balance and the range of values over all steps.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct MassBalance {
    mass: f64,
    turnover: f64,
    pub(super) error: f64,
    pub(super) range: [f64; 2],
}

impl MassBalance {
    pub(super) fn new(system: &System<'_>, values: &[f64]) -> Self {
        let mass = system.mass(values);
        let [low, high] = system
            .parameters
            .initial
            .iter()
            .fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], &x| [a.min(x), b.max(x)]);
        Self { mass, turnover: mass, error: 0.0, range: [low, high] }
    }

    pub(super) fn add_step(&mut self, system: &System<'_>, stepped: &Stepped) {
        let mass = system.mass(&stepped.values);
        self.turnover += stepped.gross;
        let scale = self.turnover.max(mass).max(f64::MIN_POSITIVE);
        let error = (mass - self.mass - stepped.net).abs() / scale;
        self.error = if error > self.error || error.is_nan() { error } else { self.error };
        self.mass = mass;
        for &x in &stepped.values {
            self.range = [self.range[0].min(x), self.range[1].max(x)];
        }
    }
}
