//! Values at vertices and faces that are written with a mesh.

use crate::appearance::{Appearance, CornerValues, Materials};
use pompeiu_core::TriMesh;

/// The name of colour arrays, which scalars cannot have.
pub(super) const COLORS: &str = "Colors";

/// Why values cannot be attributes of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AttributeError {
    /// The number of values is not that of the elements.
    #[error("{name}: {found} values for {expected} {elements}")]
    Length {
        /// The name of the attribute.
        name: String,
        /// `"vertices"` or `"faces"`.
        elements: &'static str,
        /// The number of elements.
        expected: usize,
        /// The number of values.
        found: usize,
    },
    /// The name is invalid in some format.
    #[error(
        "attribute name {name:?} is empty, has white space or control characters, or means something else in PLY"
    )]
    Name {
        /// The name.
        name: String,
    },
    /// A corner refers to texture coordinates, a normal or a colour that does not exist.
    #[error("face {face} names {name} {index}, but there are {values} (the first is 0)")]
    Corner {
        /// What is named, in the plural.
        name: &'static str,
        /// The face.
        face: usize,
        /// The index it holds.
        index: u32,
        /// Number of values.
        values: usize,
    },
    /// A face refers to a material that does not exist.
    #[error("face {face} names material {index}, but there are {names} (the first is 0)")]
    Material {
        /// The face.
        face: usize,
        /// The index it holds.
        index: u32,
        /// Number of materials.
        names: usize,
    },
    /// The name is used already.
    #[error("there are two attributes of the {elements} named {name:?}")]
    Duplicate {
        /// The name.
        name: String,
        /// `"vertices"` or `"faces"`.
        elements: &'static str,
    },
}

/// Named scalars, vectors and colours of the vertices and faces of one mesh.
///
/// # Shapes and units
/// One double per element and scalar, in a unit of the caller's, NaN and infinities included; at most one colour
/// per element, red, green and blue from 0 to 255. The counts are those of the mesh it was made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Attributes {
    vertices: OfElements,
    faces: OfElements,
    texture: Vec<CornerValues<2>>,
    image: Option<Vec<u8>>,
    normals: Option<CornerValues<3>>,
    linear_colors: Option<CornerValues<4>>,
    materials: Option<Materials>,
}

#[derive(Clone, Debug, PartialEq)]
struct OfElements {
    elements: &'static str,
    count: usize,
    scalars: Vec<(String, Vec<f64>)>,
    vectors: Vec<(String, Vec<[f64; 3]>)>,
    colors: Option<Vec<[u8; 3]>>,
}

impl Attributes {
    /// An empty set of attributes.
    pub fn for_mesh(mesh: &TriMesh) -> Self {
        let of = |elements, count| OfElements {
            elements,
            count,
            scalars: Vec::new(),
            vectors: Vec::new(),
            colors: None,
        };
        Self {
            vertices: of("vertices", mesh.positions().len()),
            faces: of("faces", mesh.faces().len()),
            texture: Vec::new(),
            image: None,
            normals: None,
            linear_colors: None,
            materials: None,
        }
    }

    /// Adds one number per vertex.
    ///
    /// # Errors
    /// [`AttributeError`] unless there is one value per vertex and the name is new among the vertex scalars, made of
    /// ASCII letters, digits, `_` and `-`, and not one that PLY or VTP use (`x`, `red`, `Colors`, …).
    pub fn with_vertex_scalar(
        mut self,
        name: impl Into<String>,
        values: Vec<f64>,
    ) -> Result<Self, AttributeError> {
        self.vertices.push_scalar(name.into(), values)?;
        Ok(self)
    }

    /// Adds one number per face.
    ///
    /// # Errors
    /// As [`with_vertex_scalar`](Self::with_vertex_scalar), for faces.
    pub fn with_face_scalar(
        mut self,
        name: impl Into<String>,
        values: Vec<f64>,
    ) -> Result<Self, AttributeError> {
        self.faces.push_scalar(name.into(), values)?;
        Ok(self)
    }

    /// Adds one vector per face. In PLY it becomes the properties `NAME_x`, `NAME_y` and `NAME_z`.
    ///
    /// # Errors
    /// As [`with_vertex_scalar`](Self::with_vertex_scalar), for faces; the name must also differ from those of scalars.
    pub fn with_face_vector(
        mut self,
        name: impl Into<String>,
        values: Vec<[f64; 3]>,
    ) -> Result<Self, AttributeError> {
        self.faces.push_vector(name.into(), values)?;
        Ok(self)
    }

    /// Sets the colours of the vertices.
    ///
    /// # Errors
    /// [`AttributeError::Length`] unless there is one per vertex.
    pub fn with_vertex_colors(mut self, colors: Vec<[u8; 3]>) -> Result<Self, AttributeError> {
        self.vertices.set_colors(colors)?;
        Ok(self)
    }

    /// Sets the colours of the faces.
    ///
    /// # Errors
    /// [`AttributeError::Length`] unless there is one per face.
    pub fn with_face_colors(mut self, colors: Vec<[u8; 3]>) -> Result<Self, AttributeError> {
        self.faces.set_colors(colors)?;
        Ok(self)
    }

    /// Adds a set of texture coordinates, from the lower left corner of the image in units of its sides, and for each corner of each
    /// face the index of its coordinates. There is a seam where the corners at a vertex have different coordinates. The image, if any,
    /// is the content of a PNG file, for the first set.
    ///
    /// # Errors
    /// [`AttributeError::Length`] unless there is one triple per face; [`AttributeError::Corner`] for an index out of range.
    pub fn with_texture(
        mut self,
        coordinates: Vec<[f64; 2]>,
        corners: Vec<[u32; 3]>,
        image: Option<Vec<u8>>,
    ) -> Result<Self, AttributeError> {
        let set = CornerValues { values: coordinates, corners };
        self.check_corners("texture coordinates", &set)?;
        self.texture.push(set);
        self.image = image.or(self.image);
        Ok(self)
    }

    /// Sets the image that the first set of texture coordinates is for: the content of a PNG file.
    #[must_use]
    pub fn with_image(mut self, image: Vec<u8>) -> Self {
        self.image = Some(image);
        self
    }

    /// Sets normals for shading, of length 1. Where none are set, formats with normals have those of [`OutputFormat::Glb`](super::OutputFormat::Glb).
    ///
    /// # Errors
    /// As [`with_texture`](Self::with_texture).
    pub fn with_normals(mut self, normals: CornerValues<3>) -> Result<Self, AttributeError> {
        self.check_corners("normals", &normals)?;
        self.normals = Some(normals);
        Ok(self)
    }

    /// Sets colours as glTF has them: linear red, green and blue, and opacity, from 0 to 1. Formats that have them prefer them to
    /// [the colours of vertices](Self::with_vertex_colors); others need those.
    ///
    /// # Errors
    /// As [`with_texture`](Self::with_texture).
    pub fn with_linear_colors(mut self, colors: CornerValues<4>) -> Result<Self, AttributeError> {
        self.check_corners("colours", &colors)?;
        self.linear_colors = Some(colors);
        Ok(self)
    }

    /// Sets all that is known of how the mesh looks.
    ///
    /// # Errors
    /// Those of the single parts.
    pub fn with_appearance(mut self, appearance: Appearance) -> Result<Self, AttributeError> {
        if let Some(colors) = appearance.colors {
            self = self.with_vertex_colors(colors)?;
        }
        if let Some(colors) = appearance.linear_colors {
            self = self.with_linear_colors(colors)?;
        }
        for set in appearance.texture {
            self = self.with_texture(set.values, set.corners, None)?;
        }
        if let Some(normals) = appearance.normals {
            self = self.with_normals(normals)?;
        }
        match appearance.materials {
            Some(materials) => self.with_materials(materials),
            None => Ok(self),
        }
    }

    fn check_corners<const N: usize>(
        &self,
        name: &'static str,
        set: &CornerValues<N>,
    ) -> Result<(), AttributeError> {
        self.faces.check_length(name, set.corners.len())?;
        let values = set.values.len();
        match set.corners.as_flattened().iter().position(|index| *index as usize >= values) {
            Some(at) => {
                let index = set.corners.as_flattened()[at];
                Err(AttributeError::Corner { name, face: at / 3, index, values })
            }
            None => Ok(()),
        }
    }

    /// Sets the materials of the faces.
    ///
    /// # Errors
    /// [`AttributeError::Length`] unless there is one per face; [`AttributeError::Material`] for an index without a name.
    pub fn with_materials(mut self, materials: Materials) -> Result<Self, AttributeError> {
        self.faces.check_length("materials", materials.faces.len())?;
        if let Some(face) = materials.faces.iter().position(|m| *m as usize >= materials.names.len()) {
            let (index, names) = (materials.faces[face], materials.names.len());
            return Err(AttributeError::Material { face, index, names });
        }
        self.materials = Some(materials);
        Ok(self)
    }

    pub(super) fn materials(&self) -> Option<&Materials> {
        self.materials.as_ref()
    }

    pub(super) fn texture(&self) -> &[CornerValues<2>] {
        &self.texture
    }

    pub(super) fn image(&self) -> Option<&[u8]> {
        self.image.as_deref()
    }

    pub(super) fn normals(&self) -> Option<&CornerValues<3>> {
        self.normals.as_ref()
    }

    pub(super) fn linear_colors(&self) -> Option<&CornerValues<4>> {
        self.linear_colors.as_ref()
    }

    /// Names and values of the vertex scalars, in the order added.
    pub fn vertex_scalars(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.vertices.scalars()
    }

    /// Names and values of the face scalars, in the order added.
    pub fn face_scalars(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.faces.scalars()
    }

    /// Names and values of the face vectors, in the order added.
    pub fn face_vectors(&self) -> impl Iterator<Item = (&str, &[[f64; 3]])> {
        self.faces.vectors.iter().map(|(name, values)| (name.as_str(), values.as_slice()))
    }

    /// The colour of each vertex.
    pub fn vertex_colors(&self) -> Option<&[[u8; 3]]> {
        self.vertices.colors.as_deref()
    }

    /// The colour of each face.
    pub fn face_colors(&self) -> Option<&[[u8; 3]]> {
        self.faces.colors.as_deref()
    }

    pub(super) fn check_fits(&self, mesh: &TriMesh) -> Result<(), AttributeError> {
        for (of, expected) in [(&self.vertices, mesh.positions().len()), (&self.faces, mesh.faces().len())] {
            if of.count != expected {
                let (name, elements, found) = ("attributes of another mesh".into(), of.elements, of.count);
                return Err(AttributeError::Length { name, elements, expected, found });
            }
        }
        Ok(())
    }
}

impl OfElements {
    fn push_scalar(&mut self, name: String, values: Vec<f64>) -> Result<(), AttributeError> {
        let name = self.checked(name, values.len())?;
        self.scalars.push((name, values));
        Ok(())
    }

    fn push_vector(&mut self, name: String, values: Vec<[f64; 3]>) -> Result<(), AttributeError> {
        let name = self.checked(name, values.len())?;
        self.vectors.push((name, values));
        Ok(())
    }

    /// The name, if it is valid and unused; `values` of them.
    fn checked(&self, name: String, values: usize) -> Result<String, AttributeError> {
        const PLY_PROPERTIES: [&str; 11] =
            ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "vertex_index", "vertex_indices"];
        let taken = PLY_PROPERTIES.contains(&name.as_str()) || name == COLORS;
        let unreadable = |c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '-');
        if name.is_empty() || name.contains(unreadable) || taken {
            return Err(AttributeError::Name { name });
        }
        // In PLY the components of a vector are separate properties.
        let is_component = |vector: &str, scalar: &str| {
            scalar.strip_prefix(vector).is_some_and(|rest| matches!(rest, "_x" | "_y" | "_z"))
        };
        let mut scalars = self.scalars.iter().map(|(other, _)| other);
        let mut vectors = self.vectors.iter().map(|(other, _)| other);
        if scalars.any(|other| *other == name || is_component(&name, other))
            || vectors.any(|other| *other == name || is_component(other, &name))
        {
            return Err(AttributeError::Duplicate { name, elements: self.elements });
        }
        self.check_length(&name, values)?;
        Ok(name)
    }

    fn set_colors(&mut self, colors: Vec<[u8; 3]>) -> Result<(), AttributeError> {
        self.check_length("colours", colors.len())?;
        self.colors = Some(colors);
        Ok(())
    }

    fn check_length(&self, name: &str, found: usize) -> Result<(), AttributeError> {
        if found == self.count {
            return Ok(());
        }
        let (name, elements, expected) = (name.to_owned(), self.elements, self.count);
        Err(AttributeError::Length { name, elements, expected, found })
    }

    fn scalars(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.scalars.iter().map(|(name, values)| (name.as_str(), values.as_slice()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_belong_is_refused() {
        let mesh = TriMesh::new(vec![[0.0; 3]; 4], vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        let none = || Attributes::for_mesh(&mesh);
        let length = |elements, expected, found| {
            move |error: AttributeError| {
                matches!(error, AttributeError::Length { elements: e, expected: x, found: f, .. }
                    if e == elements && x == expected && f == found)
            }
        };
        assert!(none().with_vertex_scalar("a", vec![0.0; 3]).is_err_and(length("vertices", 4, 3)));
        assert!(none().with_face_scalar("a", vec![0.0; 4]).is_err_and(length("faces", 2, 4)));
        assert!(none().with_vertex_colors(vec![[0; 3]; 2]).is_err_and(length("vertices", 4, 2)));
        assert!(none().with_face_colors(vec![]).is_err_and(length("faces", 2, 0)));
        for name in ["", "a b", "a\n", "é", "a<b", "x", "blue", "vertex_indices", "Colors"] {
            let error = none().with_vertex_scalar(name, vec![0.0; 4]).unwrap_err();
            assert_eq!(error, AttributeError::Name { name: name.into() });
        }
        let twice = none().with_face_scalar("a", vec![0.0; 2]).unwrap().with_face_scalar("a", vec![1.0; 2]);
        assert_eq!(twice, Err(AttributeError::Duplicate { name: "a".into(), elements: "faces" }));
    }
}
