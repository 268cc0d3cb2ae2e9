//! One module per format, and the dispatch between them.

mod csv;
pub(crate) mod gltf;
mod obj;
pub(crate) mod off;
mod ply;
pub(crate) mod stl;
mod three_mf;
mod vtk;
mod xyz;

use crate::appearance::Appearance;
use crate::error::FormatError;
use crate::format::Format;
use crate::raw::RawMesh;
use crate::solids::Solids;
use pompeiu_core::TriMesh;
use std::path::{Path, PathBuf};

/// The content of a file, decompressed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) bytes: &'a [u8],
    /// The folder of the file, for formats that refer to other files; `None` when there is no file.
    pub(crate) folder: Option<&'a Path>,
    /// Size of the file as stored, in bytes: smaller than the content if it was compressed.
    pub(crate) stored_bytes: u64,
}

/// Reads `input` as `format`.
pub(crate) fn read(format: Format, input: Input<'_>) -> Result<RawMesh, FormatError> {
    match format {
        Format::Obj => obj::read(input.bytes),
        Format::Ply => ply::read(input.bytes),
        Format::Off => off::read(input.bytes),
        Format::Stl => stl::read(input.bytes),
        Format::Gltf => gltf::read_json(input),
        Format::Glb => gltf::read_binary(input),
        Format::VtkLegacy => vtk::read_legacy(input.bytes),
        Format::Vtp => vtk::read_poly_data(input),
        Format::Vtu => vtk::read_unstructured_grid(input),
        Format::ThreeMf => three_mf::read(input),
        Format::Xyz => xyz::read(input.bytes),
    }
}

/// The other files that `input` refers to for its geometry.
pub(crate) fn referenced_files(format: Format, input: Input<'_>) -> Vec<PathBuf> {
    match format {
        Format::Gltf | Format::Glb => gltf::referenced_files(input),
        _ => Vec::new(),
    }
}

/// Reads the solid cells of `input`; `None` if the format has none.
pub(crate) fn read_solids<const N: usize>(
    format: Option<Format>,
    input: Input<'_>,
) -> Option<Result<Solids<N>, FormatError>> {
    match format {
        Some(Format::VtkLegacy) => Some(vtk::read_legacy_solids(input.bytes)),
        Some(Format::Vtu) => Some(vtk::read_solids(input)),
        _ => None,
    }
}

/// Reads the appearance of a mesh that was read from `input`, and what else the file has.
pub(crate) fn read_appearance(
    format: Format,
    input: Input<'_>,
    mesh: &TriMesh,
) -> Result<Appearance, FormatError> {
    match format {
        Format::Obj => obj::read_appearance(input.bytes, mesh),
        Format::Ply => {
            let colors = ply::read_vertex_colors(input.bytes)?;
            let colors = colors.filter(|colors| colors.len() == mesh.positions().len());
            Ok(Appearance { colors, left_out: ply::left_out(input.bytes)?, ..Appearance::default() })
        }
        Format::Gltf => gltf::json_appearance(input, mesh),
        Format::Glb => gltf::binary_appearance(input, mesh),
        _ => Ok(Appearance { left_out: left_out(format, input)?, ..Appearance::default() }),
    }
}

/// What a file has besides its surface, in formats of which nothing else is read.
fn left_out(format: Format, input: Input<'_>) -> Result<Vec<String>, FormatError> {
    match format {
        Format::Stl => Ok(stl::left_out(input.bytes)),
        Format::Off => off::left_out(input.bytes),
        Format::VtkLegacy => vtk::left_out_of_legacy(input.bytes),
        Format::Vtp => vtk::left_out(input, "PolyData"),
        Format::Vtu => vtk::left_out(input, "UnstructuredGrid"),
        Format::ThreeMf => three_mf::left_out(input),
        _ => Ok(Vec::new()),
    }
}

/// Reads the vectors of faces from `input`, as CSV when there is no `format`; `None` if the format has none.
pub(crate) fn read_face_vectors(
    format: Option<Format>,
    input: Input<'_>,
    name: Option<&str>,
) -> Option<Result<Vec<[f64; 3]>, FormatError>> {
    Some(match format {
        None => csv::read_vectors(input.bytes),
        Some(Format::Ply) => ply::read_face_vectors(input.bytes, name),
        Some(Format::Vtp) => vtk::read_cell_vectors(input, "PolyData", name),
        Some(Format::Vtu) => vtk::read_cell_vectors(input, "UnstructuredGrid", name),
        Some(_) => return None,
    })
}
