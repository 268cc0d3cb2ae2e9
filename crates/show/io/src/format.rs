//! The file formats by name.

use std::fmt;
use std::path::Path;

/// A mesh file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Stanford polygon file, ascii or binary.
    Ply,
    /// Stereolithography file, ascii or binary.
    Stl,
    /// Geomview object file.
    Off,
    /// glTF 2.0 as JSON.
    Gltf,
    /// glTF 2.0 in one binary file.
    Glb,
    /// Legacy VTK file.
    VtkLegacy,
    /// VTK XML `PolyData`.
    Vtp,
    /// VTK XML unstructured grid.
    Vtu,
    /// 3D Manufacturing Format, a zip archive.
    ThreeMf,
    /// Points as text, a line each.
    Xyz,
}

impl Format {
    /// All formats, in the order of the enumeration.
    pub const ALL: [Self; 11] = [
        Self::Obj,
        Self::Ply,
        Self::Stl,
        Self::Off,
        Self::Gltf,
        Self::Glb,
        Self::VtkLegacy,
        Self::Vtp,
        Self::Vtu,
        Self::ThreeMf,
        Self::Xyz,
    ];

    /// The usual suffix of file names, in lower case and without the dot.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Off => "off",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
            Self::VtkLegacy => "vtk",
            Self::Vtp => "vtp",
            Self::Vtu => "vtu",
            Self::ThreeMf => "3mf",
            Self::Xyz => "xyz",
        }
    }

    /// The format of a suffix, in any case and with or without a final `.gz`.
    ///
    /// `None` for an unknown or missing suffix.
    pub fn from_path(path: impl AsRef<Path>) -> Option<Self> {
        let name = path.as_ref().file_name()?.to_string_lossy().to_ascii_lowercase();
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        let (_, suffix) = name.rsplit_once('.')?;
        match suffix {
            "coff" | "noff" | "cnoff" | "stoff" => Some(Self::Off),
            "asc" | "pts" => Some(Self::Xyz),
            _ => Self::ALL.into_iter().find(|format| format.suffix() == suffix),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
            Self::VtkLegacy => "legacy VTK",
            Self::Vtp => "VTP",
            Self::Vtu => "VTU",
            Self::ThreeMf => "3MF",
            Self::Xyz => "XYZ",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_decides_in_any_case_and_under_gz() {
        assert_eq!(Format::from_path("a/b.OBJ"), Some(Format::Obj));
        assert_eq!(Format::from_path("b.ply.gz"), Some(Format::Ply));
        assert_eq!(Format::from_path("b.coff"), Some(Format::Off));
        assert_eq!(Format::from_path("cloud.PTS"), Some(Format::Xyz));
        assert_eq!(Format::from_path("obj"), None);
        assert_eq!(Format::from_path("b.txt"), None);
        assert_eq!(Format::from_path("/"), None);
    }
}
