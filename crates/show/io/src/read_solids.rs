//! Reading meshes of solid cells.

use crate::error::{FormatError, Location, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::solids::{Hexahedra, Solids, Tetrahedra};
use crate::{ReadMesh, read, sniff, source};
use std::path::Path;

/// What a file holds: a surface or a solid.
#[derive(Clone, Debug)]
pub enum SurfaceOrSolid {
    /// Faces.
    Surface(ReadMesh),
    /// Tetrahedra.
    Solid(Tetrahedra),
}

/// Reads a hexahedral mesh: the hexahedra and voxels of a VTK unstructured grid, `.vtk` or `.vtu`, compressed with gzip or not.
/// Cells of lower dimension are omitted.
///
/// # Errors
/// [`ReadError`] names the file, the place, what was found and what was expected; also for solids of other types.
pub fn read_hexahedra(path: impl AsRef<Path>) -> Result<Hexahedra, ReadError> {
    read_solids(path.as_ref())
}

/// Reads a tetrahedral mesh: the tetrahedra of a VTK unstructured grid, `.vtk` or `.vtu`, compressed with gzip or not.
/// Cells of lower dimension are omitted.
///
/// # Errors
/// [`ReadError`] names the file, the place, what was found and what was expected; also for solids of other types.
pub fn read_tetrahedra(path: impl AsRef<Path>) -> Result<Tetrahedra, ReadError> {
    read_solids(path.as_ref())
}

/// Reads tetrahedra where a VTK unstructured grid has some, else a surface in any of the formats.
///
/// # Errors
/// [`ReadError`], as for [`read`](crate::read), or [`read_tetrahedra`] where the grid has solid cells of other types.
pub fn read_surface_or_solid(path: impl AsRef<Path>) -> Result<SurfaceOrSolid, ReadError> {
    let path = path.as_ref();
    match read_tetrahedra(path) {
        Ok(solid) if !solid.cells.is_empty() => Ok(SurfaceOrSolid::Solid(solid)),
        // The cell that it names is a solid one, of which the reader of surfaces has less to say.
        Err(ReadError::Format { path, cause }) if matches!(cause.location, Location::Face(_)) => {
            Err(ReadError::Format { path, cause })
        }
        _ => read(path).map(SurfaceOrSolid::Surface),
    }
}

fn read_solids<const N: usize>(path: &Path) -> Result<Solids<N>, ReadError> {
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    from_bytes(&bytes).map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes<const N: usize>(bytes: &[u8]) -> Result<Solids<N>, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    let format = sniff::format(&content);
    let input = Input { bytes: &content, folder: None, stored_bytes: bytes.len() as u64 };
    formats::read_solids(format, input).unwrap_or_else(|| {
        let name = format.map_or("?", Format::suffix).to_uppercase();
        let problem = format!("found a {name} file, expected an unstructured grid in VTK or VTU");
        Err(FormatError::new(Location::File, problem))
    })
}
