//! The map in a file.

use crate::printer::Printer;
use anyhow::bail;
use pompeiu::core::TriMesh;
use pompeiu::flatten::Flattening;
use pompeiu::flatten::show::checker_png;
use pompeiu::io::{Appearance, Attributes, CornerValues, OutputFormat, write_as};
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
    (flat, mut looks): (&Flattening, Appearance),
    printer: &Printer,
) -> anyhow::Result<()> {
    let shown = path.display();
    let map = CornerValues { values: flat.uv.to_vec(), corners: flat.opened.faces().to_vec() };
    let descriptions = looks.materials.as_mut().and_then(|materials| materials.descriptions.as_mut());
    let image =
        if format == OutputFormat::Glb && descriptions.is_none() { Some(checker_png()?) } else { None };
    if let Some(descriptions) = descriptions {
        descriptions.shift_texture_sets(1);
    }
    looks.texture.insert(0, map);
    if looks.texture.len() > format.texture_sets() {
        looks.texture.truncate(format.texture_sets());
        printer.warning(format_args!("{shown}: the map takes the place of texture coordinates of the input"));
    }
    let mut attributes = Attributes::for_mesh(mesh).with_appearance(looks)?;
    if let Some(image) = image {
        attributes = attributes.with_image(image);
    }
    write_as(path, format, mesh, &attributes)?;
    let places = crate::numbers::grouped(flat.uv.len() as u64);
    printer.note(format_args!("{shown}: {places} texture coordinates"));
    Ok(())
}
