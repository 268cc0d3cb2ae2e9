//! Appearance of a mesh in a file: colours, texture coordinates, materials.

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

/// A colour channel from its share of the greatest value.
pub(crate) fn channel(share: f64) -> u8 {
    // Values out of range are clamped, and so is NaN.
    (255.0 * share).round() as u8
}
