//! VTK files: the legacy format, and `PolyData` and `UnstructuredGrid` of the XML formats.

mod cells;
mod legacy;
mod markup;
mod numbers;
mod stream;
mod xml;

use super::Input;
use crate::error::FormatError;

pub(super) use legacy::{read as read_legacy, read_solids as read_legacy_solids};
pub(super) use xml::{read_cell_vectors, read_poly_data, read_solids, read_unstructured_grid};

/// What a file of the legacy format has besides its surface.
pub(super) fn left_out_of_legacy(bytes: &[u8]) -> Result<Vec<String>, FormatError> {
    Ok(legacy::has_data(bytes)?.then(|| "data of points and cells".to_owned()).into_iter().collect())
}

/// What a file of an XML format has besides its surface.
pub(super) fn left_out(input: Input<'_>, kind: &str) -> Result<Vec<String>, FormatError> {
    let names = xml::array_names(input, kind)?;
    let quoted: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    Ok((!names.is_empty()).then(|| format!("arrays {}", quoted.join(", "))).into_iter().collect())
}
