//! Why nothing is transported.

use pompeiu_solve::SolveError;
use pompeiu_volume::VolumeError;

/// Why nothing is transported.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The configuration is no TOML.
    #[error("{0}")]
    Syntax(String),
    /// A key that means nothing here.
    #[error("line {line}: there is no key {key:?} in [{table}]; expected one of {expected}")]
    UnknownKey {
        /// Line of the file, from 1.
        line: usize,
        /// The table.
        table: String,
        /// The key.
        key: String,
        /// Those there are.
        expected: String,
    },
    /// A value that is no quantity of its kind.
    #[error("line {line}: {key} is {found}; expected {expected}")]
    Value {
        /// Line of the file, from 1.
        line: usize,
        /// The key.
        key: String,
        /// What is there.
        found: String,
        /// What should be.
        expected: String,
    },
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
    /// A state that is not of this mesh or run.
    #[error("the state to go on from has {found} {what}, expected {expected}: it is of another mesh or run")]
    State {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Nothing can come in.
    #[error(
        "no root of the skeleton is a flat end, so that there is no inlet: the root is inside the neuron or is a soma; name the sample of a tip with [inlet] sample, or for a mesh a side of it with [inlet] side"
    )]
    NoInlet,
    /// The sample is no flat end.
    #[error("sample {sample} is no flat end of the mesh; the flat ends are at samples {ends}")]
    NotAnEnd {
        /// The sample.
        sample: i64,
        /// Those there are.
        ends: String,
    },
    /// There is no way out.
    #[error("the neuron has no flat end beside its inlet, so that nothing can flow")]
    NoOutlet,
    /// It would take too much memory.
    #[error("transport on {cells} cells would take about {needed} MiB, more than the limit of {limit} MiB")]
    Memory {
        /// Cells.
        cells: usize,
        /// MiB, estimated.
        needed: usize,
        /// MiB that may be used.
        limit: usize,
    },
    /// A linear system cannot be solved.
    #[error("a linear system of the transport cannot be solved: {0}")]
    Solve(#[from] SolveError),
    /// Cells cannot be cut.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}
