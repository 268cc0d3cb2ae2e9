//! Stereolithography files, binary and ascii.
//!
//! Equal positions become one vertex, in the order of first appearance. Normals, colours, attributes and names are
//! skipped. A file is binary when its length is the one its triangle count asks for, whatever it begins with; else
//! ascii when it begins with `solid` and its start is text; else it is binary and either truncated or followed by
//! other data, which are skipped.

mod ascii;
mod binary;

use crate::error::FormatError;
use crate::raw::RawMesh;

/// Reads an STL file.
pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    if binary::has_the_promised_length(bytes) || !ascii::looks_like_it(bytes) {
        binary::read(bytes)
    } else {
        ascii::read(bytes).map_err(|problem| problem.in_text(bytes))
    }
}

pub(crate) use ascii::looks_like_it as is_ascii;
pub(crate) use binary::has_the_promised_length as is_binary;

#[cfg(test)]
mod tests;
