//! The mesh, as Python sees it.

use crate::arrays::{array_of_rows, faces, vectors};
use crate::errors::Raise;
use crate::json::written;
use numpy::PyArray2;
use pompeiu::core::mesh::{unit_factor, without_unreferenced};
use pompeiu::core::{MeshSummary, TriMesh};
use pompeiu::hausdorff::NamedFaces;
use pyo3::prelude::*;

/// A triangle mesh, checked once: finite coordinates, indices in range, at least one face.
///
/// Nothing else is promised: faces may be degenerate, duplicated, turned or non-manifold, and vertices unreferenced (these
/// never count). A mesh does not change, and can be shared by threads, pickled and compared.
///
/// Parameters
/// ----------
/// vertices : array_like of float, shape (n, 3)
///     Coordinates, in any unit of length. An array of float64 is copied once, straight from its memory, read-only or
///     strided as it may be; other types are converted first.
/// faces : array_like of int, shape (m, 3)
///     Indices of vertices, the first vertex is 0.
///
/// Raises
/// ------
/// MeshError
///     If the arrays are no mesh; the message names the first vertex or face that is wrong.
#[allow(clippy::doc_markdown, reason = "read by people of Python, in whose own form of documentation it is")]
#[pyclass(frozen, module = "pompeiu")]
pub(crate) struct Mesh(TriMesh, Vec<NamedFaces>);

impl From<TriMesh> for Mesh {
    fn from(mesh: TriMesh) -> Self {
        Self(mesh, Vec::new())
    }
}

impl Mesh {
    /// A mesh with the groups of faces that its file names.
    pub(crate) fn with_groups(mesh: TriMesh, groups: Vec<NamedFaces>) -> Self {
        Self(mesh, groups)
    }

    pub(crate) fn inner(&self) -> &TriMesh {
        &self.0
    }

    pub(crate) fn groups(&self) -> &[NamedFaces] {
        &self.1
    }
}

#[pymethods]
impl Mesh {
    #[new]
    fn new(py: Python<'_>, vertices: &Bound<'_, PyAny>, faces: &Bound<'_, PyAny>) -> PyResult<Self> {
        let positions = vectors::<3>(vertices, "vertices", "(n, 3)")?;
        let faces = self::faces(faces, positions.len())?;
        py.detach(|| TriMesh::new(positions, faces)).map(Self::from).map_err(Raise::raise)
    }

    /// A copy of the coordinates: float64, shape (n, 3), read-only.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_rows(py, self.0.positions().to_vec())
    }

    /// A copy of the indices: uint32, shape (m, 3), read-only.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        array_of_rows(py, self.0.faces().to_vec())
    }

    /// Number of vertices, unreferenced ones included.
    #[getter]
    fn n_vertices(&self) -> usize {
        self.0.positions().len()
    }

    /// Number of faces.
    #[getter]
    fn n_faces(&self) -> usize {
        self.0.faces().len()
    }

    /// The same mesh without the vertices that no face names; the others keep their order.
    fn without_unreferenced(&self, py: Python<'_>) -> Self {
        // Faces keep their order, and so their names.
        Self(py.detach(|| without_unreferenced(&self.0)), self.1.clone())
    }

    fn _summary(&self, py: Python<'_>) -> PyResult<String> {
        written(&py.detach(|| MeshSummary::of(&self.0)))
    }

    /// See [`unit_factor`].
    fn _unit_factor(&self, other: &Self) -> Option<(f64, bool)> {
        unit_factor(&self.0, &other.0)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.0 == other.get().0)
    }

    fn __repr__(&self) -> String {
        format!("Mesh({} vertices, {} faces)", self.0.positions().len(), self.0.faces().len())
    }

    /// Two arrays, which pickling passes on without a copy where its protocol allows.
    #[allow(clippy::type_complexity, reason = "a class and its arguments, as pickling wants them")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>))> {
        let (py, mesh) = (slf.py(), slf.get());
        Ok((slf.get_type().into_any(), (mesh.vertices(py)?, mesh.faces(py)?)))
    }
}
