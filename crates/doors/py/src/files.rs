//! Reading and writing files.

use crate::arrays::{colors, values, vectors};
use crate::errors::{Raise, UnreadableFile};
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait;
use pompeiu::hausdorff::NamedFaces;
use pompeiu::io::{self, Attributes};
use pompeiu::options::options_of_toml;
use pyo3::prelude::*;
use std::path::PathBuf;

/// The mesh of a file, its format, and how many of its faces were cut into triangles and how many were left out.
#[pyfunction]
pub(crate) fn read_mesh(py: Python<'_>, path: PathBuf) -> PyResult<(Mesh, String, u64, u64)> {
    let read = wait::abandonable(py, move || io::read(path))?.map_err(Raise::raise)?;
    let groups =
        read.groups.iter().map(|group| NamedFaces { name: group.name.clone(), faces: group.faces.clone() });
    let mesh = Mesh::with_groups(read.mesh, groups.collect());
    Ok((mesh, read.format.to_string(), read.polygons_triangulated, read.faces_dropped))
}

/// The mesh of a file, or its points where it has no faces, each as a face without extent; and whether these are points.
#[pyfunction]
pub(crate) fn read_mesh_or_points(py: Python<'_>, path: PathBuf) -> PyResult<(Mesh, bool)> {
    let read = wait::abandonable(py, move || io::read_mesh_or_points(path))?.map_err(Raise::raise)?;
    Ok((Mesh::from(read.mesh), read.is_cloud))
}

/// Whether a file has the suffix of a mesh.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn is_mesh_file(path: PathBuf) -> bool {
    io::Format::from_path(&path).is_some()
}

/// The options in a TOML file, as JSON.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn read_options(path: PathBuf) -> PyResult<String> {
    let text = std::fs::read_to_string(&path)
        .map_err(|error| UnreadableFile { path: path.clone(), error }.raise())?;
    written(&options_of_toml(&text).map_err(Raise::raise)?)
}

/// Writes a file whole or not at all.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn write_whole(path: PathBuf, content: &[u8]) -> PyResult<()> {
    io::write_whole(path, content).map_err(Raise::raise)
}

/// A name and an array for each attribute.
type Named<'py> = Vec<(String, Bound<'py, PyAny>)>;

/// Writes a mesh with what travels with it.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "one for each kind of attribute")]
pub(crate) fn write_mesh(
    py: Python<'_>,
    path: PathBuf,
    mesh: &Bound<'_, Mesh>,
    vertex_scalars: Named<'_>,
    face_scalars: Named<'_>,
    face_vectors: Named<'_>,
    vertex_colors: Option<&Bound<'_, PyAny>>,
    face_colors: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let mut attributes = Attributes::for_mesh(mesh.get().inner());
    for (name, array) in vertex_scalars {
        let values = values(&array, "vertex scalars")?;
        attributes = attributes.with_vertex_scalar(name, values).map_err(Raise::raise)?;
    }
    for (name, array) in face_scalars {
        let values = values(&array, "face scalars")?;
        attributes = attributes.with_face_scalar(name, values).map_err(Raise::raise)?;
    }
    for (name, array) in face_vectors {
        let values = vectors::<3>(&array, "face vectors", "(m, 3)")?;
        attributes = attributes.with_face_vector(name, values).map_err(Raise::raise)?;
    }
    if let Some(array) = vertex_colors {
        let colors = colors(array, "vertex colours")?;
        attributes = attributes.with_vertex_colors(colors).map_err(Raise::raise)?;
    }
    if let Some(array) = face_colors {
        let colors = colors(array, "face colours")?;
        attributes = attributes.with_face_colors(colors).map_err(Raise::raise)?;
    }
    let mesh = mesh.clone().unbind();
    wait::abandonable(py, move || io::write_with(path, mesh.get().inner(), &attributes))?
        .map_err(Raise::raise)
}
