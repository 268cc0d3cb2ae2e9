//! Errors of writing.

use super::{AttributeError, OutputFormat};
use pompeiu_core::VertexId;
use std::io;
use std::path::PathBuf;

/// Why a mesh file could not be written; displays as one line that begins with the file name.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The suffix names no format.
    #[error(
        "{}: the suffix names no format that can be written ({})",
        path.display(),
        OutputFormat::ALL.map(OutputFormat::suffix).join(", ")
    )]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The format cannot represent the mesh or an attribute.
    #[error("{}: {source}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: EncodeError,
    },
}

/// Why a mesh could not be encoded in a format.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The destination failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The attributes belong to a mesh with other counts.
    #[error(transparent)]
    Attribute(#[from] AttributeError),
    /// The format cannot store an attribute.
    #[error("{} has no place for {attribute}", format.name())]
    Unsupported {
        /// The format.
        format: OutputFormat,
        /// The attribute, in the plural.
        attribute: &'static str,
    },
    /// A coordinate overflows the single precision of the format.
    #[error(
        "coordinate {} of vertex {} is {value:e}; {} holds single precision, at most {:e}",
        ["x", "y", "z"][*axis], vertex.0, format.name(), f32::MAX
    )]
    SinglePrecision {
        /// The format.
        format: OutputFormat,
        /// The vertex.
        vertex: VertexId,
        /// 0, 1 or 2.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// The file would exceed the largest length that the format can state.
    #[error("{} files hold at most {limit} bytes; this mesh takes {bytes}", format.name())]
    TooLong {
        /// The format.
        format: OutputFormat,
        /// The bytes needed.
        bytes: u64,
        /// The largest length in bytes.
        limit: u64,
    },
}
