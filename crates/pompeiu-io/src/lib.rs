//! Reading and writing triangle meshes.
//!
//! Formats are recognised by content. Nothing is allocated on a header's word alone, and no input makes a reader
//! panic: what cannot be read is a [`ReadError`] that names the file and the place.

mod error;
mod raw;
mod write;

pub use error::{FormatError, Location, ReadError};
pub use write::{
    AttributeError, Attributes, EncodeError, OutputFormat, WriteError, encode, write, write_as, write_with,
};
