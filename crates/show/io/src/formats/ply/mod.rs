//! Stanford PLY, ascii and binary in both byte orders.
//!
//! Reads the coordinates `x`, `y` and `z` of element `vertex`, of any number type; the lists `vertex_indices` or `vertex_index` of
//! element `face`, of any integer types; and the same lists of element `tristrips`. There a negative index ends a strip, and
//! triangles with a repeated corner only join others and are omitted. Everything else is skipped; elements and properties may come
//! in any order. In ascii files every row is on a line of its own, and a coordinate becomes the nearest double even where the
//! header says `float`, because many programs write `float` and more digits than it holds.

mod ascii;
mod binary;
mod header;

use crate::appearance::channel;
use crate::error::FormatError;
use crate::raw::RawMesh;
use header::{Encoding, Header};

/// Reads a PLY file.
pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    let header = Header::parse(bytes).map_err(|problem| problem.in_text(bytes))?;
    match header.encoding {
        Encoding::Ascii => ascii::read(bytes, &header).map_err(|problem| problem.in_text(bytes)),
        Encoding::LittleEndian => binary::read::<false>(bytes, &header),
        Encoding::BigEndian => binary::read::<true>(bytes, &header),
    }
}

/// Reads three properties of element `face` as vectors: those named `NAME_x`, `NAME_y`, `NAME_z` (or without the underscore), or
/// the only ones.
pub(crate) fn read_face_vectors(bytes: &[u8], wanted: Option<&str>) -> Result<Vec<[f64; 3]>, FormatError> {
    let header = Header::parse(bytes).map_err(|problem| problem.in_text(bytes))?;
    let columns = header.face_vector(wanted).map_err(|problem| problem.in_text(bytes))?;
    read_columns(bytes, &header, b"face", columns)
}

/// Reads the colours of element `vertex`, if there are any.
pub(crate) fn read_vertex_colors(bytes: &[u8]) -> Result<Option<Vec<[u8; 3]>>, FormatError> {
    let header = Header::parse(bytes).map_err(|problem| problem.in_text(bytes))?;
    let Some((columns, most)) = header.vertex_colors() else { return Ok(None) };
    let rows = read_columns(bytes, &header, b"vertex", columns)?;
    Ok(Some(rows.into_iter().map(|row| [0, 1, 2].map(|i| channel(row[i] / most[i]))).collect()))
}

/// What the file has besides its surface and the colours of vertices.
pub(crate) fn left_out(bytes: &[u8]) -> Result<Vec<String>, FormatError> {
    let header = Header::parse(bytes).map_err(|problem| problem.in_text(bytes))?;
    Ok(header.left_out())
}

/// Reads three numbers of each row of an element.
fn read_columns(
    bytes: &[u8],
    header: &Header,
    element: &[u8],
    columns: [usize; 3],
) -> Result<Vec<[f64; 3]>, FormatError> {
    match header.encoding {
        Encoding::Ascii => {
            ascii::read_columns(bytes, header, element, columns).map_err(|problem| problem.in_text(bytes))
        }
        Encoding::LittleEndian => binary::read_columns::<false>(bytes, header, element, columns),
        Encoding::BigEndian => binary::read_columns::<true>(bytes, header, element, columns),
    }
}

/// Adds the triangles of a strip, or of several strips separated by negative indices.
fn push_strips(mesh: &mut RawMesh, indices: &[i64]) {
    for strip in indices.split(|&index| index < 0) {
        for (at, corners) in strip.windows(3).enumerate() {
            let [a, b, c] = [corners[0] as u32, corners[1] as u32, corners[2] as u32];
            if a != b && b != c && c != a {
                mesh.faces.push(if at % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        }
    }
}

#[cfg(test)]
mod tests;
