//! Hexahedral meshes, read from a file.

use crate::error::{FormatError, Location, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::{sniff, source};
use std::path::Path;

/// The hexahedra of a file; only the indices are checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hexahedra {
    /// Places of vertices.
    pub positions: Vec<[f64; 3]>,
    /// Cells: four vertices around the bottom, counter-clockwise seen from above, and the four above them.
    pub cells: Vec<[u32; 8]>,
    /// The point data named `label`, if there is any.
    pub labels: Option<Vec<f64>>,
}

/// Reads a hexahedral mesh: the hexahedra and voxels of a VTK unstructured grid, `.vtk` or `.vtu`, compressed with gzip or not.
/// Cells of lower dimension are omitted.
///
/// # Errors
/// [`ReadError`] names the file, the place, what was found and what was expected; also for solids of other types.
pub fn read_hexahedra(path: impl AsRef<Path>) -> Result<Hexahedra, ReadError> {
    let path = path.as_ref();
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    from_bytes(&bytes).map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes(bytes: &[u8]) -> Result<Hexahedra, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    let format = sniff::format(&content);
    let input = Input { bytes: &content, folder: None, stored_bytes: bytes.len() as u64 };
    formats::read_hexahedra(format, input).unwrap_or_else(|| {
        let name = format.map_or("?", Format::suffix).to_uppercase();
        let problem = format!("found a {name} file, expected an unstructured grid in VTK or VTU");
        Err(FormatError::new(Location::File, problem))
    })
}

impl Hexahedra {
    /// Adds the hexahedra of a list of cells; corners are relative to the points from `base` on.
    pub(crate) fn add(
        &mut self,
        base: usize,
        (corners, ends): (&[u64], &[u64]),
        types: &[u64],
    ) -> Result<(), FormatError> {
        let points = (self.positions.len() - base) as u64;
        let mut begin = 0;
        for (cell, (&end, &kind)) in ends.iter().zip(types).enumerate() {
            let wrong = |problem: String| FormatError::new(Location::Face(cell as u64), problem);
            let list =
                usize::try_from(end).ok().and_then(|end| corners.get(begin..end)).ok_or_else(|| {
                    wrong(format!("its corners end at {end}, expected {begin} to {}", corners.len()))
                })?;
            begin += list.len();
            // Voxels have their corners in lexicographic order.
            let order = match kind {
                0..=9 => continue,
                11 => [0, 1, 3, 2, 4, 5, 7, 6],
                12 => [0, 1, 2, 3, 4, 5, 6, 7],
                other => {
                    return Err(wrong(format!("a cell of VTK's type {other}, expected hexahedra (12)")));
                }
            };
            let list: [u64; 8] = list
                .try_into()
                .map_err(|_| wrong(format!("a hexahedron with {} corners, expected 8", list.len())))?;
            if let Some(corner) = list.iter().find(|corner| **corner >= points) {
                return Err(wrong(format!(
                    "corner {corner}, but there are {points} points (the first is 0)"
                )));
            }
            self.cells.push(order.map(|k| (list[k] + base as u64) as u32));
        }
        Ok(())
    }
}
