//! Tangent fields in files.

use crate::files;
use crate::numbers::plain;
use crate::printer::Printer;
use pompeiu::io::read_face_vectors;
use pompeiu::operators::FieldSource;

/// The vectors of the file that a field is named by, if it is one; `name` chooses among several.
pub(crate) fn vectors(source: &FieldSource, name: Option<&str>) -> anyhow::Result<Option<Vec<[f64; 3]>>> {
    let Some(path) = source.file() else { return Ok(None) };
    files::check_readable(path)?;
    Ok(Some(read_face_vectors(path, name)?))
}

/// Warns of vectors that are not tangent.
pub(crate) fn warn_of_normal_part(
    source: &FieldSource,
    (is_tangent, normal_part): (bool, f64),
    printer: &Printer,
) {
    if !is_tangent {
        printer.warning(format_args!(
            "{source}: vectors are not tangent: a part of length {} along the normal was left out",
            plain(normal_part)
        ));
    }
}
