//! Errors of viscous flow.

use crate::mesh::ended_by;
use pompeiu_core::run::StopReason;
use pompeiu_solve::SolveError;
use pompeiu_volume::VolumeError;

/// Why a flow cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A parameter is out of range.
    #[error("{what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// The parameter.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        expected: &'static str,
    },
    /// There is no inlet.
    #[error(
        "no root of the skeleton is a flat end, so that there is no inlet: the root is inside the neuron, is a soma, or lies on a branch that is left out; name the sample of a tip with [inlet] sample, or for a mesh a side of it with [inlet] side"
    )]
    NoInlet,
    /// The given sample is no flat end.
    #[error("sample {sample} is no flat end of the mesh; the flat ends are at samples {ends}")]
    NotAnEnd {
        /// The sample.
        sample: i64,
        /// The flat ends.
        ends: String,
    },
    /// A component of the mesh has no end with a given pressure.
    #[error("a part of the neuron has no flat end beside its inlet, so that nothing can flow")]
    NoOutlet,
    /// The memory limit is too small.
    #[error(
        "flow with {unknowns} unknowns would take about {needed} MiB, more than the limit of {limit} MiB"
    )]
    Memory {
        /// Unknowns.
        unknowns: usize,
        /// Estimated need in MiB.
        needed: usize,
        /// The limit in MiB.
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
    /// The computation was stopped.
    #[error("ended by {} before the flow was solved for", ended_by(*.0))]
    Stopped(StopReason),
    /// A linear system cannot be solved.
    #[error("a linear system of the flow cannot be solved: {0}")]
    Solve(#[from] SolveError),
    /// Cells cannot be subdivided.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}
