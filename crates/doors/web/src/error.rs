//! Why a call has no answer.

use pompeiu::core::MeshError;
use pompeiu::figures::FigureError;
use pompeiu::figures::page::PageError;
use pompeiu::io::{EncodeError, FormatError, OutputFormat};
use pompeiu::options::OptionsError;
use std::error::Error;

/// Why a call has no answer; displays as a sentence that says what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CallError {
    /// The call is no JSON, or none of those that are known.
    #[error("the call cannot be understood: {0}")]
    Syntax(#[from] serde_json::Error),
    /// The bytes beside a call are not those that it needs.
    #[error("the call needs {expected} arrays of bytes beside it, found {found}")]
    Arrays {
        /// Number that is there.
        found: usize,
        /// Number that is needed.
        expected: usize,
    },
    /// An array whose length is no number of rows.
    #[error("an array has {bytes} bytes; its rows have {row} bytes each")]
    Rows {
        /// Its length.
        bytes: usize,
        /// Bytes of a row.
        row: usize,
    },
    /// A file that holds no usable mesh.
    #[error("{name}: {problem}")]
    Read {
        /// The name of the file.
        name: String,
        /// What is wrong, and where.
        problem: FormatError,
    },
    /// Arrays that are no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh that the engine does not hold.
    #[error("there is no mesh {0}; read it first")]
    NoMesh(u32),
    /// A system is asked about another number of meshes.
    #[error("{command} is about {expected} meshes, found {found}")]
    Count {
        /// The system.
        command: &'static str,
        /// Number of meshes that it is about.
        expected: usize,
        /// Number that was given.
        found: usize,
    },
    /// A system that is not here.
    #[error("there is no command `{0}` here; known are {1}")]
    Command(String, String),
    /// Options that cannot be used.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// A limit that makes no sense.
    #[error("{0}")]
    Limit(String),
    /// The system says why there is no answer.
    #[error("{0}")]
    System(#[source] Box<dyn Error + Send + Sync>),
    /// Nothing was found that could be shown.
    #[error("nothing was found yet that could be {0}; ask a system first")]
    NothingFound(&'static str),
    /// A format that is not written.
    #[error("a mesh cannot be written as `{0}`; known are {known}", known = OutputFormat::ALL.map(OutputFormat::suffix).join(", "))]
    Format(String),
    /// A mesh that the format cannot hold.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A page that cannot be made.
    #[error(transparent)]
    Page(#[from] PageError),
    /// A picture that cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
}

impl CallError {
    pub(crate) fn of_system(error: impl Error + Send + Sync + 'static) -> Self {
        Self::System(Box::new(error))
    }
}
