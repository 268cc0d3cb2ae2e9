//! The measured meshes, with their deviation as numbers and as colours.

use crate::files;
use crate::interrupt::while_writing;
use crate::numbers::counted;
use crate::printer::Printer;
use anyhow::bail;
use pompeiu::core::TriMesh;
use pompeiu::figures::{ColorMap, Scale};
use pompeiu::hausdorff::deviation::{DirectedDeviation, FaceDeviation};
use pompeiu::io::{Attributes, OutputFormat, write_with};
use std::path::Path;

/// Refuses, before any work is done, what cannot hold colours.
pub(super) fn check(path: &Path) -> anyhow::Result<()> {
    files::check_writable(path)?;
    if OutputFormat::from_path(path) == Some(OutputFormat::Stl) {
        bail!("{}: STL has no room for colours; write PLY, VTP, VTU, GLB, OBJ or OFF", path.display());
    }
    Ok(())
}

/// `extent` is the distance that the end of the colour scale stands for.
pub(super) fn write(
    path: &Path,
    mesh: &TriMesh,
    deviation: &DirectedDeviation,
    extent: f64,
    printer: &Printer,
) -> anyhow::Result<()> {
    let (name, values, scale) = match deviation.signed_vertices() {
        Some(values) => ("signed_distance", values, Scale::symmetric(ColorMap::Vik, extent)?),
        None => ("distance", deviation.vertices.clone(), Scale::new(ColorMap::Viridis, 0.0, extent)?),
    };
    let colors = values.iter().map(|&value| scale.color(value)).collect();
    let mut attributes = Attributes::for_mesh(mesh).with_vertex_colors(colors)?;
    if OutputFormat::from_path(path).is_some_and(OutputFormat::holds_scalars) {
        attributes = attributes.with_vertex_scalar(name, values)?;
        let of_faces =
            |value: fn(&FaceDeviation) -> f64| deviation.faces.iter().map(value).collect::<Vec<_>>();
        attributes = attributes
            .with_face_scalar("max_lower", of_faces(|face| face.max.lower()))?
            .with_face_scalar("max_upper", of_faces(|face| face.max.upper()))?
            .with_face_scalar("mean_lower", of_faces(|face| face.mean.lower()))?
            .with_face_scalar("mean_upper", of_faces(|face| face.mean.upper()))?;
        if let Some(sides) = &deviation.sides {
            attributes = attributes
                .with_vertex_scalar("winding_number", sides.vertex_winding.clone())?
                .with_face_scalar("winding_number", sides.face_winding.clone())?;
        }
    }
    while_writing(|| write_with(path, mesh, &attributes))?;
    let faces = counted(mesh.faces().len(), "face");
    let from = scale.range().0;
    printer.note(format_args!("{}: {faces}, coloured from {from:.4} to {extent:.4}", path.display()));
    Ok(())
}
