//! Some surfaces of a flow, kept on the way.

use crate::{FlowObserver, FlowStep};
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

/// A surface after a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Number of the step; 0 is the surface given.
    pub step: usize,
    /// Positions of vertices.
    pub positions: Vec<[f64; 3]>,
    /// Vertices of faces.
    pub faces: Vec<[u32; 3]>,
}

/// Keeps surfaces of a flow: all of the first ones, later every second, fourth and so on, so that there are never more than asked.
#[derive(Debug)]
pub struct Frames {
    most: usize,
    kept: Mutex<(usize, Vec<Frame>)>,
}

impl Frames {
    /// Keeps at most this many surfaces, at least two, beside the last one.
    pub fn new(most: usize) -> Self {
        Self { most: most.max(2), kept: Mutex::new((1, Vec::new())) }
    }

    /// The surfaces kept, in order.
    pub fn into_frames(self) -> Vec<Frame> {
        self.kept.into_inner().unwrap_or_else(PoisonError::into_inner).1
    }
}

impl FlowObserver for Frames {
    fn step(&self, step: &FlowStep<'_>) -> ControlFlow<()> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let (stride, frames) = &mut *kept;
        // The last one is always there: it is replaced by the next unless its turn has come.
        if frames.last().is_some_and(|last| last.step % *stride != 0) {
            frames.pop();
        }
        if frames.len() >= self.most {
            *stride *= 2;
            frames.retain(|frame| frame.step % *stride == 0);
        }
        frames.push(Frame {
            step: step.step,
            positions: step.positions.to_vec(),
            faces: step.faces.to_vec(),
        });
        ControlFlow::Continue(())
    }
}
