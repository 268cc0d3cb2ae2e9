//! One module per format, and the one place that knows them all.

mod gltf;
mod obj;
pub(crate) mod off;
mod ply;
pub(crate) mod stl;
mod vtk;

use crate::error::FormatError;
use crate::format::Format;
use crate::raw::RawMesh;
use std::path::Path;

/// The content of a file, decompressed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) bytes: &'a [u8],
    /// The folder of the file, for formats that refer to other files; `None` when there is no file.
    pub(crate) folder: Option<&'a Path>,
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
        Format::Vtp => vtk::read_poly_data(input.bytes),
        Format::Vtu => vtk::read_unstructured_grid(input.bytes),
    }
}
