//! Errors of transport.

use crate::mesh::ended_by;
use pompeiu_core::run::StopReason;
use pompeiu_solve::SolveError;
use pompeiu_volume::VolumeError;

/// Why transport cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The configuration is not valid TOML.
    #[error("{0}")]
    Syntax(String),
    /// A key is unknown.
    #[error("{}there is no key {key:?} in [{table}]; expected one of {expected}", at(*.line))]
    UnknownKey {
        /// Line of the file, from 1; 0 if it is in no file.
        line: usize,
        /// The table.
        table: String,
        /// The key.
        key: String,
        /// The known keys.
        expected: String,
    },
    /// A value is not a quantity of the expected kind.
    #[error("{}{key} is {found}; expected {expected}", at(*.line))]
    Value {
        /// Line of the file, from 1; 0 if it is in no file.
        line: usize,
        /// The key.
        key: String,
        /// What is there.
        found: String,
        /// What was expected.
        expected: String,
    },
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
    /// A state belongs to another mesh or run.
    #[error("the state to go on from has {found} {what}, expected {expected}: it is of another mesh or run")]
    State {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
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
    /// There is no outlet.
    #[error("the neuron has no flat end beside its inlet, so that nothing can flow")]
    NoOutlet,
    /// The memory limit is too small.
    #[error("transport on {cells} cells would take about {needed} MiB, more than the limit of {limit} MiB")]
    Memory {
        /// Cells.
        cells: usize,
        /// Estimated need in MiB.
        needed: usize,
        /// The limit in MiB.
        limit: usize,
    },
    /// The computation was stopped before the first step.
    #[error("ended by {} before the transport began", ended_by(*.0))]
    Stopped(StopReason),
    /// A linear system cannot be solved.
    #[error("a linear system of the transport cannot be solved: {0}")]
    Solve(#[from] SolveError),
    /// Cells cannot be subdivided.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}

/// The place of an error, where there is a file.
fn at(line: usize) -> String {
    if line == 0 { String::new() } else { format!("line {line}: ") }
}

#[cfg(feature = "serde")]
impl TransportError {
    /// The error of a table that is in no file.
    pub(crate) fn without_line(mut self) -> Self {
        if let Self::UnknownKey { line, .. } | Self::Value { line, .. } = &mut self {
            *line = 0;
        }
        self
    }
}
