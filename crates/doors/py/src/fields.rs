//! Splitting tangent fields.

use crate::arrays::{array_of, array_of_rows, vectors};
use crate::errors::{Raise, unknown};
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait;
use numpy::{PyArray1, PyArray2};
use pompeiu::core::mesh::FaceData;
use pompeiu::fields::{Decomposition, DecompositionOptions, DegreesOfFreedom, HodgeSolver};
use pompeiu::operators::{self, Boundary, FaceField, Splitting, tangent_field};
use pompeiu::surface::{EmbeddedSurface, SurfaceMesh};
use pyo3::prelude::*;
use self_cell::self_cell;

self_cell!(
    /// A surface, and the solver that refers to it.
    struct Prepared {
        owner: EmbeddedSurface,
        #[covariant]
        dependent: HodgeSolver,
    }
);

fn splitting(name: &str) -> PyResult<Splitting> {
    match name {
        "primal" => Ok(Splitting::Primal),
        "dual" => Ok(Splitting::Dual),
        found => {
            let expected = "\"primal\" or \"dual\"";
            Err(unknown("splitting", found, expected))
        }
    }
}

fn boundary(name: &str) -> PyResult<Boundary> {
    match name {
        "tangential" => Ok(Boundary::Tangential),
        "normal" => Ok(Boundary::Normal),
        found => {
            let expected = "\"tangential\" or \"normal\"";
            Err(unknown("boundary", found, expected))
        }
    }
}

/// The degrees of freedom of a surface, counted.
#[pyfunction]
pub(crate) fn degrees_of_freedom(mesh: &Bound<'_, Mesh>, boundary: &str) -> PyResult<String> {
    let surface = SurfaceMesh::new(mesh.get().inner()).map_err(|error| {
        let error: pompeiu::surface::GeometryError = error.into();
        error.raise()
    })?;
    written(&DegreesOfFreedom::of(&surface, self::boundary(boundary)?))
}

/// The three parts of a field, in space, with what they are made of.
#[derive(IntoPyObject)]
pub(crate) struct Parts<'py> {
    gradient: Bound<'py, PyArray2<f64>>,
    rotated: Bound<'py, PyArray2<f64>>,
    harmonic: Bound<'py, PyArray2<f64>>,
    vertex_potential: Bound<'py, PyArray1<f64>>,
    edge_potential: Bound<'py, PyArray1<f64>>,
    harmonic_coefficients: Bound<'py, PyArray1<f64>>,
    normal_part: f64,
    quality: String,
}

/// A surface made ready to split fields: factored once.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct HodgeDecomposition(Prepared);

impl HodgeDecomposition {
    fn surface(&self) -> &EmbeddedSurface {
        self.0.borrow_owner()
    }

    fn field(&self, field: &Bound<'_, PyAny>) -> PyResult<(FaceField, f64)> {
        let vectors = vectors::<3>(field, "vectors of the field", "(m, 3)")?;
        let vectors = FaceData::new(self.surface().mesh().faces(), vectors).map_err(|error| {
            operators::OperatorError::FieldLength { found: error.found, expected: error.expected }.raise()
        })?;
        Ok(tangent_field(self.surface(), &vectors))
    }

    fn in_space<'py>(&self, py: Python<'py>, field: &FaceField) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let surface = self.surface();
        array_of_rows(py, field.entries().map(|(face, &vector)| surface.to_space(face, vector)).collect())
    }

    fn parts<'py>(&self, py: Python<'py>, parts: Decomposition, normal_part: f64) -> PyResult<Parts<'py>> {
        Ok(Parts {
            gradient: self.in_space(py, &parts.gradient)?,
            rotated: self.in_space(py, &parts.rotated)?,
            harmonic: self.in_space(py, &parts.harmonic)?,
            vertex_potential: array_of(py, parts.vertex_potential.into_vec())?,
            edge_potential: array_of(py, parts.edge_potential.into_vec())?,
            harmonic_coefficients: array_of(py, parts.harmonic_coefficients)?,
            normal_part,
            quality: written(&parts.quality)?,
        })
    }
}

#[pymethods]
impl HodgeDecomposition {
    #[new]
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>, splitting: &str, boundary: &str) -> PyResult<Self> {
        let options = DecompositionOptions {
            splitting: self::splitting(splitting)?,
            boundary: self::boundary(boundary)?,
        };
        let mesh = mesh.clone().unbind();
        wait::abandonable(py, move || {
            let surface = EmbeddedSurface::new(mesh.get().inner()).map_err(Raise::raise)?;
            Prepared::try_new(surface, |surface| HodgeSolver::new(surface.surface(), &options))
                .map(Self)
                .map_err(Raise::raise)
        })?
    }

    fn decompose<'py>(
        slf: &Bound<'py, Self>,
        py: Python<'py>,
        field: &Bound<'py, PyAny>,
    ) -> PyResult<Parts<'py>> {
        let (field, normal_part) = slf.get().field(field)?;
        let held = slf.clone().unbind();
        let parts = wait::abandonable(py, move || held.get().0.borrow_dependent().decompose(&field))?;
        slf.get().parts(py, parts.map_err(Raise::raise)?, normal_part)
    }

    fn decompose_many<'py>(
        slf: &Bound<'py, Self>,
        py: Python<'py>,
        fields: &Bound<'py, PyAny>,
    ) -> PyResult<Vec<Parts<'py>>> {
        let this = slf.get();
        let fields: Vec<_> = fields.try_iter()?.map(|field| this.field(&field?)).collect::<PyResult<_>>()?;
        let (fields, normal_parts): (Vec<_>, Vec<_>) = fields.into_iter().unzip();
        let held = slf.clone().unbind();
        let parts = wait::abandonable(py, move || held.get().0.borrow_dependent().decompose_many(&fields))?;
        let parts = parts.map_err(Raise::raise)?;
        parts.into_iter().zip(normal_parts).map(|(parts, normal)| this.parts(py, parts, normal)).collect()
    }

    /// The harmonic fields, orthonormal, in space.
    fn harmonic_fields<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let basis = self.0.borrow_dependent().basis();
        basis.fields().iter().map(|field| self.in_space(py, field)).collect()
    }

    /// The ends of every edge, in the order of the potential at edges.
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let mesh = self.surface().mesh();
        array_of_rows(py, mesh.edge_ids().map(|edge| mesh.ends(edge).map(|vertex| vertex.0)).collect())
    }

    /// The areas of faces, the weights of the inner product of fields.
    fn face_areas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        array_of(py, self.surface().surface().face_areas().into_vec())
    }

    /// Dimension of the harmonic fields.
    #[getter]
    fn harmonic_dimension(&self) -> usize {
        self.0.borrow_dependent().basis().dimension()
    }

    fn degrees_of_freedom(&self) -> PyResult<String> {
        written(&DegreesOfFreedom::of(self.surface().mesh(), self.0.borrow_dependent().boundary()))
    }
}
