//! The map in a file.

use crate::printer::Printer;
use anyhow::bail;
use pompeiu::core::TriMesh;
use pompeiu::flatten::Flattening;
use pompeiu::flatten::show::checker_png;
use pompeiu::io::{Attributes, OutputFormat, write_as};
use std::ffi::OsStr;
use std::path::Path;

/// What a file holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Textured(OutputFormat),
    Drawing,
    Picture,
}

/// What a file is to hold, by its suffix.
pub(super) fn kind(path: &Path) -> anyhow::Result<Kind> {
    let suffix = path.extension().map(OsStr::to_ascii_lowercase);
    Ok(match (suffix.as_deref().and_then(|suffix| suffix.to_str()), OutputFormat::from_path(path)) {
        (Some("svg"), _) => Kind::Drawing,
        (Some("png"), _) => Kind::Picture,
        (_, Some(format @ (OutputFormat::Obj | OutputFormat::Glb))) => Kind::Textured(format),
        _ => bail!("{}: a map is written as .obj, .glb, .svg or .png", path.display()),
    })
}

/// Writes the mesh with its texture coordinates.
pub(super) fn write_textured(
    path: &Path,
    format: OutputFormat,
    mesh: &TriMesh,
    flat: &Flattening,
    printer: &Printer,
) -> anyhow::Result<()> {
    let image = if format == OutputFormat::Glb { Some(checker_png()?) } else { None };
    let (coordinates, corners) = (flat.uv.to_vec(), flat.opened.faces().to_vec());
    let attributes = Attributes::for_mesh(mesh).with_texture(coordinates, corners, image)?;
    write_as(path, format, mesh, &attributes)?;
    let places = crate::numbers::grouped(flat.uv.len() as u64);
    printer.note(format_args!("{}: {places} texture coordinates", path.display()));
    Ok(())
}
