//! VTK files: the legacy format, and `PolyData` and `UnstructuredGrid` of the XML formats.

mod cells;
mod legacy;
mod markup;
mod numbers;
mod stream;
mod xml;

pub(super) use legacy::{read as read_legacy, read_solids as read_legacy_solids};
pub(super) use xml::{read_cell_vectors, read_poly_data, read_solids, read_unstructured_grid};
