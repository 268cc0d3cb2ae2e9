//! Errors of reading, with their place in the file.

use std::fmt;
use std::path::PathBuf;

/// Where in a file a problem was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Location {
    /// The file as a whole.
    File,
    /// A line of a text file, counted from 1.
    Line(u64),
    /// A byte offset, counted from 0.
    Byte(u64),
    /// A face in file order, counted from 0.
    Face(u64),
    /// A vertex in file order, counted from 0.
    Vertex(u64),
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(n) => write!(f, "line {n}: "),
            Self::Byte(n) => write!(f, "byte {n}: "),
            Self::Face(n) => write!(f, "face {n}: "),
            Self::Vertex(n) => write!(f, "vertex {n}: "),
        }
    }
}

/// What is wrong with the content of a mesh file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{location}{problem}")]
pub struct FormatError {
    /// The place.
    pub location: Location,
    /// One sentence for a person, without the place.
    pub problem: String,
}

impl FormatError {
    pub(crate) fn new(location: Location, problem: impl Into<String>) -> Self {
        Self { location, problem: problem.into() }
    }
}

/// Why a mesh file could not be read; displays as one line that begins with the file name.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file could not be opened or read.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system said; part of the message, so not repeated as its source.
        cause: std::io::Error,
    },
    /// The content is not a usable mesh.
    #[error("{}: {cause}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where; part of the message, so not repeated as its source.
        cause: FormatError,
    },
}
