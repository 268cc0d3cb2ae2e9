//! Frames of a run for display.

use crate::Simulation;

/// Largest number of vertices in all frames of a page, of some 30 bytes each.
const MOST_VERTICES: usize = 800_000;

/// Largest number of frames in a page.
const MOST_FRAMES: usize = 120;

/// Smallest number of frames in a page.
const LEAST_FRAMES: usize = 8;

/// The number of frames in a page, for so many vertices.
fn most_frames(vertices: usize) -> usize {
    (MOST_VERTICES / vertices.max(1)).clamp(LEAST_FRAMES, MOST_FRAMES)
}

/// Bodies after a step, for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactFrame {
    /// Number of the step; 0 is the start.
    pub step: usize,
    /// Time since the start.
    pub time: f64,
    /// Positions of all vertices.
    pub positions: Vec<[f64; 3]>,
}

impl ContactFrame {
    /// The bodies as they are.
    pub fn new(simulation: &Simulation) -> Self {
        Self {
            step: simulation.steps(),
            time: simulation.time(),
            positions: simulation.positions().iter().map(glam::DVec3::to_array).collect(),
        }
    }
}

/// Frames of a run, evenly spaced but for the last, never more than a page has.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactFrames {
    frames: Vec<ContactFrame>,
    /// Steps from one frame to the next.
    stride: usize,
}

impl Default for ContactFrames {
    fn default() -> Self {
        Self { frames: Vec::new(), stride: 1 }
    }
}

impl ContactFrames {
    /// Takes over the bodies as they are after a step.
    pub fn add(&mut self, simulation: &Simulation) {
        if self.frames.last().is_some_and(|last| !last.step.is_multiple_of(self.stride)) {
            self.frames.pop();
        }
        if self.frames.len() >= most_frames(simulation.positions().len()) {
            self.stride *= 2;
            let stride = self.stride;
            self.frames.retain(|frame| frame.step.is_multiple_of(stride));
        }
        self.frames.push(ContactFrame::new(simulation));
    }

    /// The frames, in order; the last one is always there.
    pub fn frames(&self) -> &[ContactFrame] {
        &self.frames
    }
}
