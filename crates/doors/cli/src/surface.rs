//! Mesh files that must be surfaces.

use crate::files;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{unreferenced_vertices, without_unreferenced};
use pompeiu::surface::{EmbeddedSurface, GeometryError, SurfaceError, orient};
use std::path::Path;

/// Reads a mesh as an oriented surface: without vertices that no face names, and with faces turned to agree, which it tells.
pub(crate) fn read(
    path: &Path,
    wait: &Wait,
    printer: &Printer,
) -> anyhow::Result<(TriMesh, EmbeddedSurface)> {
    let mut mesh = files::read_shown(path, wait, printer)?;
    let unreferenced = unreferenced_vertices(&mesh);
    if unreferenced > 0 {
        wait.suspend(|| files::warn_of_unreferenced(path, unreferenced, printer));
        mesh = without_unreferenced(&mesh);
    }
    let shown = || path.display().to_string();
    let surface = match EmbeddedSurface::new(&mesh) {
        Err(GeometryError::Surface(SurfaceError::Misoriented { .. })) => {
            mesh = orient(&mesh).with_context(shown)?;
            wait.suspend(|| printer.warning(format_args!("{}: faces were turned over to agree", shown())));
            EmbeddedSurface::new(&mesh)
        }
        surface => surface,
    };
    Ok((mesh, surface.with_context(shown)?))
}
