//! Reading the appearance of a mesh.

use crate::appearance::Appearance;
use crate::error::{FormatError, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::{sniff, source};
use pompeiu_core::TriMesh;
use std::path::Path;

/// Reads the appearance of a mesh that was read from the same file: in PLY the colours of vertices (`red`, `green`, `blue`); in OBJ
/// colours after the coordinates of vertices, texture coordinates (`vt`) and materials (`mtllib`, `usemtl`); in glTF colours, the sets of
/// texture coordinates, at most eight, normals, and materials with their textures and images. Of other formats it only names what else
/// they have; paths that are no regular files give none.
///
/// # Limits
/// Images are kept as they are, without a look at them; an image of a glTF file that is not there stays named by its address.
///
/// # Errors
/// As [`read`](crate::read()).
/// # Cost
/// O(bytes), on one thread.
pub fn read_appearance(path: impl AsRef<Path>, mesh: &TriMesh) -> Result<Appearance, ReadError> {
    let path = path.as_ref();
    if !path.metadata().is_ok_and(|metadata| metadata.is_file()) {
        return Ok(Appearance::default());
    }
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    from_bytes(&bytes, mesh, path).map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes(bytes: &[u8], mesh: &TriMesh, path: &Path) -> Result<Appearance, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    let format = sniff::format(&content).or(Format::from_path(path));
    let input = Input { bytes: &content, folder: path.parent(), stored_bytes: bytes.len() as u64 };
    format.map_or(Ok(Appearance::default()), |format| formats::read_appearance(format, input, mesh))
}
