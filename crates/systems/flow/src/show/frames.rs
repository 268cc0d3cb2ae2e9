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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FlowRecord, GradientNorm, Scheme, StepReason};

    #[test]
    fn first_and_last_are_kept_and_the_others_thinned_out() {
        for steps in [1, 2, 3, 7, 8, 9, 100] {
            let frames = Frames::new(8);
            for step in 0..steps {
                let record = FlowRecord {
                    time: None,
                    area: 1.0,
                    gradient: GradientNorm::default(),
                    scheme: Scheme::Implicit,
                    reason: StepReason::Scheme,
                };
                let at = FlowStep { step, record: &record, positions: &[], faces: &[], share: None };
                assert!(frames.step(&at).is_continue());
            }
            let kept: Vec<usize> = frames.into_frames().iter().map(|frame| frame.step).collect();
            assert!(kept.len() <= 9 && kept.is_sorted(), "{kept:?}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, steps - 1));
        }
    }
}
