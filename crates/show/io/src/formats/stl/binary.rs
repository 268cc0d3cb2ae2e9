//! Binary STL: a header of 80 bytes, a count, and 50 bytes per triangle.

use crate::error::{FormatError, Location};
use crate::raw::RawMesh;
use crate::waves;
use crate::weld::{LocalWelder, Welder};

/// Bytes before the triangles: free text and the number of triangles.
const HEADER: usize = 84;

/// Bytes of a triangle: normal, three corners and an attribute.
const TRIANGLE: usize = 50;

/// Triangles per task.
const PIECE_TRIANGLES: usize = 8 * BLOCK_TRIANGLES;

/// Triangles that are welded to each other before their vertices are welded to all others: in most files they are neighbours and
/// share vertices, and this small table fits into the innermost cache.
const BLOCK_TRIANGLES: usize = 1 << 10;

fn promised_triangles(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEADER - 4..HEADER)?.try_into().ok().map(u32::from_le_bytes)
}

/// Whether the length of the file matches its triangle count.
pub(crate) fn has_the_promised_length(bytes: &[u8]) -> bool {
    promised_triangles(bytes)
        .is_some_and(|count| HEADER as u64 + TRIANGLE as u64 * u64::from(count) == bytes.len() as u64)
}

/// Whether the attribute of any triangle is not zero.
pub(super) fn has_attributes(bytes: &[u8]) -> bool {
    let triangles = bytes.get(HEADER..).unwrap_or_default().as_chunks::<TRIANGLE>().0;
    triangles.iter().any(|triangle| triangle[TRIANGLE - 2..] != [0, 0])
}

/// The triangles of one piece; corners are indices into the vertices found in the piece.
#[derive(Default)]
struct Piece {
    welder: LocalWelder,
    faces: Vec<[u32; 3]>,
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    let Some(count) = promised_triangles(bytes) else {
        let problem = format!("found {} bytes, expected a header of {HEADER} bytes", bytes.len());
        return Err(FormatError::new(Location::Byte(bytes.len() as u64), problem));
    };
    let body = &bytes[HEADER..];
    let whole = body.len() / TRIANGLE;
    let (here, place) = (body.len(), Location::Byte(HEADER as u64));
    if whole < count as usize {
        let problem =
            format!("found {here} bytes ({whole} triangles), expected the {count} triangles of the header");
        return Err(FormatError::new(place, problem));
    }
    if count == 0 {
        let problem =
            format!("found a count of 0 triangles before {here} bytes, expected at least one triangle");
        return Err(FormatError::new(Location::Byte(HEADER as u64 - 4), problem));
    }
    let table = &body[..count as usize * TRIANGLE];
    let pieces: Vec<(usize, &[u8])> = table.chunks(PIECE_TRIANGLES * TRIANGLE).enumerate().collect();
    let mut welder = Welder::with_capacity(count as usize / 32 * 17);
    let mut faces = Vec::with_capacity(count as usize);
    let mut indices = Vec::new();
    waves::in_order(
        &pieces,
        |&(number, table), piece: &mut Piece| parse(number * PIECE_TRIANGLES, table, piece),
        |_, piece| {
            indices.clear();
            welder.extend_indices(&piece.welder.found, &mut indices);
            faces.extend(piece.faces.iter().map(|face| face.map(|corner| indices[corner as usize])));
            Ok(())
        },
    )?;
    Ok(RawMesh { positions: welder.into_positions(), faces, ..RawMesh::default() })
}

fn parse(first: usize, table: &[u8], piece: &mut Piece) -> Result<(), FormatError> {
    piece.welder.clear();
    piece.faces.clear();
    for (at, triangle) in table.chunks_exact(TRIANGLE).enumerate() {
        if at % BLOCK_TRIANGLES == 0 {
            piece.welder.forget();
        }
        let mut corners = [[0.0_f32; 3]; 3];
        for (x, bytes) in corners.as_flattened_mut().iter_mut().zip(triangle[12..48].as_chunks().0) {
            *x = f32::from_le_bytes(*bytes);
        }
        if !corners.as_flattened().iter().all(|x| x.is_finite()) {
            return Err(not_finite(first + at, corners));
        }
        piece.faces.push(corners.map(|corner| piece.welder.index(corner)));
    }
    Ok(())
}

#[cold]
fn not_finite(face: usize, corners: [[f32; 3]; 3]) -> FormatError {
    let place = corners.as_flattened().iter().position(|x| !x.is_finite()).unwrap_or(0);
    let (corner, axis, value) = (place / 3 + 1, ["x", "y", "z"][place % 3], corners.as_flattened()[place]);
    let problem =
        format!("found coordinate {axis} = {value} of corner {corner}, expected a finite coordinate");
    FormatError::new(Location::Face(face as u64), problem)
}
