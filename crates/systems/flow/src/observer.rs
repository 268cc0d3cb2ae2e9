//! Watching a flow step by step.

use super::report::FlowRecord;
use std::ops::ControlFlow;

/// A surface after a step of a flow.
#[derive(Clone, Copy, Debug)]
pub struct FlowStep<'f> {
    /// Number of steps so far; 0 for the surface given.
    pub step: usize,
    /// What the step did.
    pub record: &'f FlowRecord,
    /// Positions of vertices, in the frame of the input.
    pub positions: &'f [[f64; 3]],
    /// Vertices of faces.
    pub faces: &'f [[u32; 3]],
    /// The share of the time or of the steps that is done, where the end is known.
    pub share: Option<f64>,
}

/// Watches a flow. A closure that takes a [`FlowStep`] is one.
pub trait FlowObserver: Send + Sync {
    /// Called for the surface given and after each step; [`ControlFlow::Break`] ends the flow.
    fn step(&self, step: &FlowStep<'_>) -> ControlFlow<()>;
}

impl<F: Fn(&FlowStep<'_>) -> ControlFlow<()> + Send + Sync> FlowObserver for F {
    fn step(&self, step: &FlowStep<'_>) -> ControlFlow<()> {
        self(step)
    }
}
