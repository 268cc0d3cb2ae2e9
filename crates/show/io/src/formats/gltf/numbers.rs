//! Numbers that tell vertices at one position apart.

use super::accessor;
use super::buffers::Buffers;
use super::document::{Document, Primitive, entry};
use crate::error::FormatError;

/// The attribute with the numbers: two unsigned shorts, the lower half first. The format has no unsigned integers for vertices, and a
/// single-precision number would be exact to 2²⁴ only.
pub(crate) const VERTEX_NUMBERS: &str = "_VERTEX";

/// The numbers of the vertices of a primitive; none where it has none in this form.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    vertices: usize,
) -> Result<Vec<u32>, FormatError> {
    let Some(index) = primitive.attributes.of(VERTEX_NUMBERS) else { return Ok(Vec::new()) };
    let accessor = entry(&document.accessors, "accessor", index)?;
    if accessor.count != vertices as u64 || !accessor::holds_pairs_of_shorts(accessor) {
        return Ok(Vec::new());
    }
    let halves = accessor::vectors::<2>(buffers, accessor, index)?;
    Ok(halves.into_iter().map(|[low, high]| low as u32 | (high as u32) << 16).collect())
}
