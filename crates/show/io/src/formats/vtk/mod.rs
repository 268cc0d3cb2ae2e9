//! VTK files: the legacy format, and `PolyData` and `UnstructuredGrid` of the XML formats.

mod cells;
mod legacy;
mod markup;
mod numbers;
mod stream;
mod xml;

pub(super) use legacy::{read as read_legacy, read_hexahedra as read_legacy_hexahedra};
pub(super) use xml::{read_cell_vectors, read_hexahedra, read_poly_data, read_unstructured_grid};
