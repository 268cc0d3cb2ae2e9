//! Appearance of a mesh in a file: colours, texture coordinates, materials.

use crate::error::{FormatError, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::{sniff, source};
use pompeiu_core::TriMesh;
use std::path::Path;

/// Colours, texture coordinates and materials of a mesh.
///
/// # Shapes and units
/// Colours are red, green and blue from 0 to 255, one for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Appearance {
    /// The colours of the vertices.
    pub colors: Option<Vec<[u8; 3]>>,
    /// Texture coordinates of the corners of faces.
    pub texture: Option<TextureCoordinates>,
    /// Materials of the faces.
    pub materials: Option<Materials>,
}

/// Texture coordinates, from the lower left corner of the image in units of its sides, and which of them each corner of each face
/// has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureCoordinates {
    /// The coordinates.
    pub coordinates: Vec<[f64; 2]>,
    /// For each face the indices of its corners' coordinates.
    pub corners: Vec<[u32; 3]>,
}

/// Names of materials, and which of them each face has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Materials {
    /// The file that describes them, as the mesh file names it.
    pub library: Option<String>,
    /// Their names; the first is empty, for faces before the first name.
    pub names: Vec<String>,
    /// The material of each face.
    pub faces: Vec<u32>,
}

/// Reads the appearance of a mesh that was read from the same file: in PLY the colours of vertices (`red`, `green`, `blue`); in OBJ
/// colours after the coordinates of vertices, texture coordinates (`vt`) and materials (`mtllib`, `usemtl`). Other formats, and
/// paths that are no regular files, give none.
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
    from_bytes(&bytes, mesh, Format::from_path(path))
        .map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes(bytes: &[u8], mesh: &TriMesh, promised: Option<Format>) -> Result<Appearance, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    let format = sniff::format(&content).or(promised);
    let input = Input { bytes: &content, folder: None, stored_bytes: bytes.len() as u64 };
    format.map_or(Ok(Appearance::default()), |format| formats::read_appearance(format, input, mesh))
}

/// A colour channel from its share of the greatest value.
pub(crate) fn channel(share: f64) -> u8 {
    // Values out of range are clamped, and so is NaN.
    (255.0 * share).round() as u8
}
