//! The field, its parts and their potentials in a file.

use crate::files;
use crate::interrupt::while_writing;
use crate::numbers::counted;
use crate::printer::Printer;
use anyhow::bail;
use pompeiu::core::TriMesh;
use pompeiu::fields::Decomposition;
use pompeiu::io::{Attributes, OutputFormat, write_with};
use pompeiu::operators::{FaceField, Splitting};
use pompeiu::surface::{EdgeData, EmbeddedSurface, SurfaceMesh};
use std::path::Path;

/// Refuses, before any work is done, what cannot hold fields.
pub(super) fn check(path: &Path) -> anyhow::Result<()> {
    files::check_writable(path)?;
    if let Some(format) = OutputFormat::from_path(path)
        && !format.holds_scalars()
    {
        bail!("{}: {} has no room for fields; write VTP, VTU or PLY", path.display(), format.name());
    }
    Ok(())
}

pub(super) fn write(
    path: &Path,
    mesh: &TriMesh,
    surface: &EmbeddedSurface,
    splitting: Splitting,
    field: &FaceField,
    parts: &Decomposition,
    printer: &Printer,
) -> anyhow::Result<()> {
    let in_space =
        |u: &FaceField| u.entries().map(|(face, &vector)| surface.to_space(face, vector)).collect();
    let (of_vertices, of_faces) = match splitting {
        Splitting::Primal => ("gradient_potential", "rotated_potential"),
        Splitting::Dual => ("rotated_potential", "gradient_potential"),
    };
    let attributes = Attributes::for_mesh(mesh)
        .with_vertex_scalar(of_vertices, parts.vertex_potential.to_vec())?
        .with_face_scalar(of_faces, at_centres(surface.mesh(), &parts.edge_potential))?
        .with_face_vector("field", in_space(field))?
        .with_face_vector("gradient", in_space(&parts.gradient))?
        .with_face_vector("rotated", in_space(&parts.rotated))?
        .with_face_vector("harmonic", in_space(&parts.harmonic))?;
    while_writing(|| write_with(path, mesh, &attributes))?;
    let faces = counted(mesh.faces().len(), "face");
    printer.note(format_args!("{}: four fields and two potentials on {faces}", path.display()));
    Ok(())
}

/// A function that is linear on faces, given at midpoints of edges, at the centres of faces.
fn at_centres(mesh: &SurfaceMesh, values: &EdgeData<f64>) -> Vec<f64> {
    mesh.face_ids()
        .map(|face| SurfaceMesh::face_halfedges(face).map(|h| values[mesh.edge(h)] / 3.0).iter().sum())
        .collect()
}
