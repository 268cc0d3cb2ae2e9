//! The formats that can be written, and what each can store.

use pompeiu_core::mesh::Precision;
use std::path::Path;

/// A format that can be written.
///
/// | | coordinates | vertex colours | face colours | vertex and face scalars, face vectors | texture coordinates | texture image | materials | normals |
/// |---|---|---|---|---|---|---|---|---|
/// | OBJ | every bit | yes | no | no | every bit, one set | no | names | no |
/// | PLY | every bit | yes | yes | yes | no | no | no | no |
/// | STL | single precision | no | no | no | no | no | no | no |
/// | OFF | every bit | yes | yes | no | no | no | no | no |
/// | VTP, VTU | every bit | yes | yes | yes | no | no | no | no |
/// | 3MF | every bit | no | no | no | no | no | no | no |
/// | GLB | single precision | yes | no | no | single precision, eight sets | yes | yes | single precision |
///
/// An attribute that the format cannot store is an error; it is never dropped silently.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum OutputFormat {
    /// Wavefront OBJ, text; each coordinate as the shortest decimal that reads back to the same double. Colours
    /// follow the coordinates, from 0 to 1.
    Obj,
    /// Stanford PLY, binary little endian, `double` coordinates and scalars, `uchar` colours.
    Ply,
    /// Binary STL: each triangle repeats its corners in single precision; vertices that no face uses are lost.
    Stl,
    /// Object File Format, text; each coordinate as the shortest decimal that reads back to the same double.
    Off,
    /// VTK XML polygonal data, for ParaView and similar programs: `Float64` coordinates and scalars, `UInt8` colours in arrays
    /// named `Colors`, all appended in little endian.
    Vtp,
    /// VTK XML unstructured grid of triangles: otherwise as [`OutputFormat::Vtp`], for programs that need cells.
    Vtu,
    /// 3D Manufacturing Format: one object, each coordinate as the shortest decimal that reads back to the same double, in millimetres.
    /// Coordinates in another unit are to be converted before. Faces that have a vertex twice are not allowed there, and refused.
    ThreeMf,
    /// glTF 2.0 in one binary file, one mesh in one node. Coordinates are rounded to single precision relative to an origin in the
    /// node's translation, so that a model far from zero keeps its shape: the error per axis is at most 2⁻²⁴ of the model's size. A
    /// mesh whose coordinates are single-precision numbers keeps every bit. Colours are interpreted as sRGB and stored linear, with
    /// sixteen bits per channel. Normals that are not given are those of the faces, smoothed across edges at which faces meet at up to 30
    /// degrees. A vertex is written once for each of its different normals, colours and texture coordinates: first all vertices in their
    /// order, then the further ones, which [`read`](crate::read()) joins again. Where vertices have equal
    /// positions, the attribute `_VERTEX` numbers them, so that they stay apart. There is one primitive for each material, so that faces of
    /// several materials change their order.
    Glb,
}

impl OutputFormat {
    /// All formats, in the order of the table above.
    pub const ALL: [Self; 8] =
        [Self::Obj, Self::Ply, Self::Stl, Self::Off, Self::Vtp, Self::Vtu, Self::ThreeMf, Self::Glb];

    /// The format for the suffix of a file name, in either case, ignoring a final `.gz`.
    pub fn from_path(path: &Path) -> Option<Self> {
        let inner = if is_gzip(path) { Path::new(path.file_stem()?) } else { path };
        let suffix = inner.extension()?;
        Self::ALL.into_iter().find(|format| suffix.eq_ignore_ascii_case(format.suffix()))
    }

    /// The suffix of file names, without the dot.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Off => "off",
            Self::Vtp => "vtp",
            Self::Vtu => "vtu",
            Self::ThreeMf => "3mf",
            Self::Glb => "glb",
        }
    }

    /// The name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Vtp => "VTP",
            Self::Vtu => "VTU",
            Self::ThreeMf => "3MF",
            Self::Glb => "GLB",
        }
    }

    /// The numbers in which it has coordinates.
    ///
    /// GLB counts as single precision although the translation of its node can hold more: programs add it in single precision.
    pub const fn precision(self) -> Precision {
        match self {
            Self::Stl | Self::Glb => Precision::Single,
            Self::Obj | Self::Ply | Self::Off | Self::Vtp | Self::Vtu | Self::ThreeMf => Precision::Double,
        }
    }

    /// Whether it can store colours of vertices.
    pub const fn holds_vertex_colors(self) -> bool {
        !matches!(self, Self::Stl | Self::ThreeMf)
    }

    pub(super) const fn holds_face_colors(self) -> bool {
        matches!(self, Self::Ply | Self::Off | Self::Vtp | Self::Vtu)
    }

    /// Whether it can store texture coordinates.
    pub const fn holds_texture(self) -> bool {
        self.texture_sets() > 0
    }

    /// How many sets of texture coordinates it can store.
    pub const fn texture_sets(self) -> usize {
        match self {
            Self::Obj => 1,
            Self::Glb => 8,
            _ => 0,
        }
    }

    /// Whether it can store normals.
    pub const fn holds_normals(self) -> bool {
        matches!(self, Self::Glb)
    }

    /// Whether it can store which material each face has, by name.
    pub const fn holds_materials(self) -> bool {
        matches!(self, Self::Obj | Self::Glb)
    }

    /// Whether it can store what materials look like ([`Descriptions`](crate::Descriptions)), and colours with opacity.
    pub const fn holds_descriptions(self) -> bool {
        matches!(self, Self::Glb)
    }

    /// Whether it can store scalars of vertices and faces, and vectors of faces.
    pub const fn holds_scalars(self) -> bool {
        matches!(self, Self::Ply | Self::Vtp | Self::Vtu)
    }
}

pub(super) fn is_gzip(path: &Path) -> bool {
    path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("gz"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suffix_names_the_format() {
        let format = |name: &str| OutputFormat::from_path(Path::new(name));
        for known in OutputFormat::ALL {
            assert_eq!(format(&format!("a/b.c.{}", known.suffix())), Some(known));
            assert_eq!(format(&format!("b.{}.GZ", known.suffix().to_uppercase())), Some(known));
        }
        for unknown in ["", "obj", ".obj", "a.gz", ".gz", "a.txt", "a.obj.txt", "a.obj/b", "a.obj.gz.gz"] {
            assert_eq!(format(unknown), None, "{unknown}");
        }
    }
}
