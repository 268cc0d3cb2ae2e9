//! Stereolithography files, binary and ascii.
//!
//! Equal positions become one vertex, in the order of first appearance. Normals, colours, attributes and names are skipped. A file
//! is binary if its length matches its triangle count, whatever it begins with. Otherwise it is ascii if it begins with `solid` and
//! its start is text. Otherwise it is binary, and either truncated or followed by other data, which is skipped.

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

/// What the file has besides its surface.
pub(crate) fn left_out(bytes: &[u8]) -> Vec<String> {
    let has_attributes = binary::has_the_promised_length(bytes) && binary::has_attributes(bytes);
    has_attributes.then(|| "attributes of triangles, which may be colours,".to_owned()).into_iter().collect()
}

pub(crate) use ascii::looks_like_it as is_ascii;
pub(crate) use binary::has_the_promised_length as is_binary;

#[cfg(test)]
mod tests;
