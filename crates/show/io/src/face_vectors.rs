//! Vectors on faces, read from a file.

use crate::error::{FormatError, Location, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::{sniff, source};
use std::path::Path;

/// Reads one vector per face: the cell data of a VTP or VTU file, properties of the faces of a PLY file, or a CSV file with
/// three numbers on each line.
///
/// In VTP and VTU a vector is a `DataArray` with three components; in PLY three properties `NAME_x`, `NAME_y`, `NAME_z` (or `NAMEx`
/// and so on). Without a name the file must hold exactly one vector. CSV has no names; numbers are separated by commas, semicolons
/// or blanks, `#` begins a comment, and a heading is skipped. NaN and infinities are read as such.
///
/// # Errors
/// [`ReadError`] names the file, the place, what was found and what was expected.
///
/// # Limits
/// The vectors belong to the faces of the file, before polygons are triangulated: compare their number with that of the mesh.
pub fn read_face_vectors(path: impl AsRef<Path>, name: Option<&str>) -> Result<Vec<[f64; 3]>, ReadError> {
    let path = path.as_ref();
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    from_bytes(&bytes, name, Format::from_path(path))
        .map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes(
    bytes: &[u8],
    name: Option<&str>,
    promised: Option<Format>,
) -> Result<Vec<[f64; 3]>, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    // OBJ is recognised by its first word, which may also begin the heading of a table.
    let format = sniff::format(&content).filter(|&format| format != Format::Obj).or(promised);
    let input = Input { bytes: &content, folder: None, stored_bytes: bytes.len() as u64 };
    formats::read_face_vectors(format, input, name).unwrap_or_else(|| {
        let name = format.map_or("?", Format::suffix).to_uppercase();
        let problem = format!("found a {name} file, expected vectors in VTP, VTU, PLY or CSV");
        Err(FormatError::new(Location::File, problem))
    })
}
