//! Wavefront OBJ.
//!
//! Reads vertices (`v`, the first three numbers), faces (`f`, the vertex index of each corner, negative ones relative to the last
//! vertex so far), and the groups (`g`) and objects (`o`) of faces. Comments begin with `#` and end with their line; in other
//! statements a backslash at the end of a line continues it. Every other statement whose keyword consists of letters is skipped.
//! Faces may refer to later vertices.

mod appearance;
mod piece;

use crate::error::FormatError;
use crate::groups::Marks;
use crate::polygon::Polygon;
use crate::raw::RawMesh;
use crate::text::{Problem, is_line_end, past_line_end};
use crate::waves;
pub(crate) use appearance::read as read_appearance;
use piece::Piece;
use std::ops::Range;

/// Bytes of text per task: its vertices and faces stay in the cache of a core until they are appended.
const PIECE_BYTES: usize = 1 << 18;

/// Bytes of a short line with a vertex.
const USUAL_VERTEX_BYTES: usize = 20;

/// Bytes of a short line with a face.
const USUAL_FACE_BYTES: usize = 14;

/// Reads an OBJ file.
pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    read_in_pieces(bytes, PIECE_BYTES).map_err(|problem| problem.in_text(bytes))
}

fn read_in_pieces(bytes: &[u8], piece_bytes: usize) -> Result<RawMesh, Problem> {
    let pieces = split(bytes, piece_bytes);
    // Reserved memory that is never written costs nothing and is returned; files rarely need more than these sizes.
    let mut mesh = RawMesh {
        positions: Vec::with_capacity(bytes.len() / USUAL_VERTEX_BYTES),
        faces: Vec::with_capacity(bytes.len() / USUAL_FACE_BYTES),
        ..RawMesh::default()
    };
    let mut largest_index = 0;
    let mut marks = Marks::default();
    waves::in_order(
        &pieces,
        |range, piece: &mut Piece| {
            piece.clear();
            piece.parse(&bytes[range.clone()], u32::MAX).map_err(|problem| problem.after(range.start))
        },
        |range, piece| {
            largest_index = largest_index.max(piece.largest_index);
            for (face, mark) in piece.marks.drain(..) {
                marks.mark(mesh.faces.len() + face, mark);
            }
            append(&mut mesh, piece).map_err(|problem| problem.after(range.start))
        },
    )?;
    if largest_index as usize >= mesh.positions.len() {
        first_index_beyond(bytes, &pieces, mesh.positions.len())?;
    }
    mesh.groups = marks.into_groups(mesh.faces.len());
    mesh.positions.shrink_to_fit();
    mesh.faces.shrink_to_fit();
    Ok(mesh)
}

/// Ranges of whole statements of about `piece_bytes` each.
fn split(bytes: &[u8], piece_bytes: usize) -> Vec<Range<usize>> {
    let mut pieces = Vec::with_capacity(bytes.len() / piece_bytes + 1);
    let mut start = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    while start < bytes.len() {
        let mut end = start.saturating_add(piece_bytes);
        loop {
            match bytes.get(end..).and_then(|rest| rest.iter().position(|&b| is_line_end(b))) {
                None => end = bytes.len(),
                Some(n) => {
                    let line_end = end + n;
                    end = past_line_end(bytes, line_end);
                    // The first byte of a CR LF may lie before `end`, so backslashes are checked before both.
                    let content = bytes[..line_end].strip_suffix(b"\r").unwrap_or(&bytes[..line_end]);
                    if content.ends_with(b"\\") {
                        continue;
                    }
                }
            }
            break;
        }
        pieces.push(start..end);
        start = end;
    }
    pieces
}

/// Appends a piece's elements to those of the pieces before it.
fn append(mesh: &mut RawMesh, piece: &mut Piece) -> Result<(), Problem> {
    for relative in &piece.relative {
        let preceding = mesh.positions.len() + relative.vertices_before;
        let index = preceding as i128 + i128::from(relative.written);
        if index < 0 {
            let written = relative.written;
            return Err(Problem::new(
                relative.offset,
                format!("found vertex index {written}, but only {preceding} vertices precede it"),
            ));
        }
        piece.faces[relative.face][relative.corner] = index as u32;
    }
    let first = mesh.faces.len() as u32;
    mesh.polygons.extend(
        piece.polygons.iter().map(|p| Polygon { first: first.wrapping_add(p.first), corners: p.corners }),
    );
    mesh.positions.extend_from_slice(&piece.positions);
    mesh.faces.extend_from_slice(&piece.faces);
    mesh.faces_dropped += piece.faces_dropped;
    Ok(())
}

/// Finds the line of the first vertex index that is too large, if there is one.
#[cold]
fn first_index_beyond(bytes: &[u8], pieces: &[Range<usize>], vertices: usize) -> Result<(), Problem> {
    let limit = u32::try_from(vertices).unwrap_or(u32::MAX);
    let mut piece = Piece::default();
    for range in pieces {
        piece.clear();
        piece.parse(&bytes[range.clone()], limit).map_err(|problem| problem.after(range.start))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
