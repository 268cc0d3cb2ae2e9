//! Why nothing flows.

use crate::mesh::ended_by;
use pompeiu_core::run::StopReason;
use pompeiu_solve::SolveError;
use pompeiu_volume::VolumeError;

/// Why there is no flow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A parameter is out of range.
    #[error("{what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// Nothing can come in.
    #[error(
        "no root of the skeleton is a flat end, so that there is no inlet: the root is inside the neuron or is a soma; name the sample of a tip with [inlet] sample, or for a mesh a side of it with [inlet] side"
    )]
    NoInlet,
    /// A sample that is named is no flat end.
    #[error("sample {sample} is no flat end of the mesh; the flat ends are at samples {ends}")]
    NotAnEnd {
        /// The sample.
        sample: i64,
        /// Those there are.
        ends: String,
    },
    /// A part of the mesh has no end at which a pressure is given.
    #[error("a part of the neuron has no flat end beside its inlet, so that nothing can flow")]
    NoOutlet,
    /// It would take too much memory.
    #[error(
        "flow with {unknowns} unknowns would take about {needed} MiB, more than the limit of {limit} MiB"
    )]
    Memory {
        /// Unknowns.
        unknowns: usize,
        /// MiB, estimated.
        needed: usize,
        /// MiB that may be used.
        limit: usize,
    },
    /// Newton's method does not converge.
    #[error(
        "Newton's method does not converge: after {steps} steps the residual is {ratio:e} of the first; the flow may be too fast to be steady"
    )]
    NoConvergence {
        /// Steps done.
        steps: usize,
        /// The residual relative to the first.
        ratio: f64,
    },
    /// It was stopped.
    #[error("ended by {} before the flow was solved for", ended_by(*.0))]
    Stopped(StopReason),
    /// A linear system cannot be solved.
    #[error("a linear system of the flow cannot be solved: {0}")]
    Solve(#[from] SolveError),
    /// Cells cannot be cut.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}
